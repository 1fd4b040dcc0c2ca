#include "core/session/result_views.h"

#include <algorithm>
#include <utility>

namespace hewn {
namespace {

constexpr std::size_t kMostViews = 8;

}  // namespace

std::vector<ResultViews::Entry>::iterator ResultViews::entry_of(const SharedResult& result) {
  return std::find_if(entries_.begin(), entries_.end(),
                      [&result](const Entry& e) { return e.result == result; });
}

ResultViews::SharedView ResultViews::find(const SharedResult& result) const {
  const auto it = std::find_if(entries_.begin(), entries_.end(),
                               [&result](const Entry& e) { return e.result == result; });
  return it == entries_.end() ? nullptr : it->view;
}

void ResultViews::add(Entry entry) {
  if (entries_.size() == kMostViews) entries_.erase(entries_.begin());
  entries_.push_back(std::move(entry));
}

void ResultViews::drop_unmade(const SharedResult& result) {
  std::erase_if(entries_, [&result](const Entry& e) { return !e.view && e.result == result; });
}

void ResultViews::drop_unmade() {
  std::erase_if(entries_, [](const Entry& e) { return !e.view; });
}

void ResultViews::put(const SharedResult& result, SharedView view) {
  if (const auto it = entry_of(result); it != entries_.end()) entries_.erase(it);
  add({result, std::move(view)});
}

int ResultViews::want(const SharedResult& result, JobQueue& jobs) {
  if (!result) return 0;
  if (const auto it = entry_of(result); it != entries_.end()) {
    std::rotate(it, it + 1, entries_.end());
    return 0;
  }
  add({result, nullptr});
  return jobs.add("drawing the result", [this, result](const RunContext& run) -> JobCompletion {
    auto view = build_result_view(result->found, run);
    return [this, result, outcome = std::move(view)]() mutable {
      const auto it = entry_of(result);
      if (it == entries_.end()) return;
      if (outcome) {
        it->view = std::make_shared<const ResultView>(std::move(*outcome));
      } else if (outcome.error().code == ErrorCode::Cancelled) {
        entries_.erase(it);  // whoever wants it later gets it
      } else {
        report_(outcome.error());
      }
    };
  });
}

}  // namespace hewn
