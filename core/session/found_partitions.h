#pragma once
/// Partitions that were searched before: an edit of the plan searches only what it changes.
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "core/session/plan.h"
#include "core/session/reconstruct.h"

namespace hewn {

/// Everything that the tree of a partition depends on: the mesh, its groups, options and seed, but
/// not its name, its operation or the other partitions.
std::string partition_key(const Project& project, const Partition& partition);

/// The newest answers by key. Thread-safe. Searches are deterministic, so an answer from here is
/// the one that a search would find.
class FoundPartitions {
 public:
  std::optional<PartitionResult> find(const std::string& key) const;
  void keep(const std::string& key, const PartitionResult& result);

 private:
  static constexpr std::size_t kMost = 256;  ///< some tens of kilobytes each

  struct Entry {
    std::string key;
    PartitionResult result;
  };
  mutable std::mutex mutex_;
  std::deque<Entry> entries_;  ///< oldest first
};

}  // namespace hewn
