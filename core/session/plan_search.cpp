#include "core/session/plan_search.h"

#include <chrono>
#include <utility>

namespace hewn {
namespace {

double total_seconds(const Reconstruction& found) {
  double sum = 0;
  for (const StageTime& time : found.times) sum += time.seconds;
  return sum;
}

SharedResult as_result(const PlanSearch& search, Reconstruction found) {
  auto result = std::make_shared<FoundResult>();
  result->project = search.document.project;
  result->key = search_key(search.document.project);
  result->source = search.source;
  result->seconds = total_seconds(found);
  result->found = std::move(found);
  return result;
}

/// Null when it is stopped: the result is worth keeping without.
std::shared_ptr<const ResultView> drawn(const FoundResult& result, BoundaryDetail detail,
                                        const RunContext& run) {
  auto view = build_result_view(result.found, run, detail);
  return view ? std::make_shared<const ResultView>(std::move(*view)) : nullptr;
}

Result<Reconstruction> find(const PlanSearch& search, const RunContext& run) {
  const Project& project = search.document.project;
  if (search.base) return with_edits(search.base->found, project, run);
  SegmentedMesh segmented;
  segmented.report = search.document.source->report;
  segmented.prepared = *search.document.prepared;
  SearchWatch watch{search.board, {}, search.found.get()};
  const auto start = std::chrono::steady_clock::now();
  if (search.on_draft) {
    watch.on_draft = [&](Reconstruction draft) {
      const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
      draft.times.push_back({"search", passed.count()});
      const SharedResult result = as_result(search, std::move(draft));
      if (auto view = drawn(*result, BoundaryDetail::Rough, beside_search(run)))
        search.on_draft({result, std::move(view)});
    };
  }
  return reconstruct(project, std::move(segmented), run, watch);
}

}  // namespace

Result<DrawnResult> search_plan(const PlanSearch& search, const RunContext& run) {
  auto found = find(search, run);
  if (!found) return found.error();
  DrawnResult out{as_result(search, std::move(*found)), nullptr};
  if (search.draws) out.view = drawn(*out.result, BoundaryDetail::Fine, run);
  return out;
}

}  // namespace hewn
