#pragma once
/// The search for a plan's tree, as a session's job does it, with what a window shows of it.
#include <functional>
#include <memory>
#include <string>

#include "core/session/document.h"
#include "core/session/found_partitions.h"
#include "core/session/part_board.h"
#include "core/session/result_view.h"

namespace hewn {

/// A tree that was found, with the plan that it belongs to. Immutable.
struct FoundResult {
  Project project;
  std::string key;     ///< `search_key` of the project
  std::string source;  ///< short: "plan", "8 starts", "seed 2"
  Reconstruction found;
  double seconds = 0;
};

using SharedResult = std::shared_ptr<const FoundResult>;

struct DrawnResult {
  SharedResult result;
  std::shared_ptr<const ResultView> view;  ///< null when none was asked for
};

struct PlanSearch {
  Document document;
  /// The result of the same plan without its edits of literals; null: search.
  SharedResult base;
  std::string source;
  bool draws = false;  ///< whether a view is wanted
  PartBoard* board = nullptr;
  std::shared_ptr<FoundPartitions> found = {};  ///< null: search all partitions
  /// Gets results on the way, drawn, from the search's threads. May be empty.
  std::function<void(const DrawnResult& draft)> on_draft = {};
};

/// Fails as `reconstruct` and `with_edits` do.
Result<DrawnResult> search_plan(const PlanSearch& search, const RunContext& run);

}  // namespace hewn
