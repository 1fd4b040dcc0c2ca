#pragma once
/// The results that a session has found, by the plan they belong to.
#include <string>
#include <vector>

#include "core/session/plan_search.h"

namespace hewn {

class ResultStore {
 public:
  /// Replaces the result with the same key, if there is one; the oldest go when there are too many.
  void keep(const SharedResult& result);
  /// Null when there is none.
  SharedResult find(const std::string& key) const;
  /// Oldest first.
  const std::vector<SharedResult>& all() const { return results_; }
  void clear() { results_.clear(); }

 private:
  std::vector<SharedResult> results_;
};

}  // namespace hewn
