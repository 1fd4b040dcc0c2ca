#include "core/session/result_store.h"

#include <algorithm>

namespace hewn {
namespace {

/// Each holds a few hundred kilobytes beside the shared mesh.
constexpr std::size_t kMostResults = 64;

}  // namespace

void ResultStore::keep(const SharedResult& result) {
  std::erase_if(results_, [&result](const SharedResult& r) { return r->key == result->key; });
  results_.push_back(result);
  if (results_.size() > kMostResults) results_.erase(results_.begin());
}

SharedResult ResultStore::find(const std::string& key) const {
  const auto found = std::find_if(results_.begin(), results_.end(),
                                  [&key](const SharedResult& r) { return r->key == key; });
  return found == results_.end() ? nullptr : *found;
}

}  // namespace hewn
