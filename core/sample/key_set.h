#pragma once
/// A set of keys that are random numbers themselves. Internal to core/sample.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hewn {

/// Open addressing without a hash function: a look-up reads one line of memory, mostly.
class KeySet {
 public:
  /// False when it was there already.
  bool insert(std::uint64_t key) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    std::uint64_t& slot = slots_[place_of(key)];
    if (slot == key + kUsed) return false;
    slot = key + kUsed;
    ++count_;
    return true;
  }

  bool contains(std::uint64_t key) const {
    return count_ > 0 && slots_[place_of(key)] == key + kUsed;
  }

  std::size_t size() const { return count_; }

 private:
  /// What is stored of a key is never 0, which marks an empty slot, but for one key in 2^64.
  static constexpr std::uint64_t kUsed = 0x9E3779B97F4A7C15ull;

  /// Where the key is, or where it belongs.
  std::size_t place_of(std::uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = key & mask;
    while (slots_[at] != 0 && slots_[at] != key + kUsed) at = (at + 1) & mask;
    return at;
  }

  void grow() {
    std::vector<std::uint64_t> old(slots_.empty() ? 64 : 4 * slots_.size(), 0);
    old.swap(slots_);
    for (const std::uint64_t slot : old) {
      if (slot != 0) slots_[place_of(slot - kUsed)] = slot;
    }
  }

  std::vector<std::uint64_t> slots_;  ///< a power of two of them, at most half of them used
  std::size_t count_ = 0;
};

}  // namespace hewn
