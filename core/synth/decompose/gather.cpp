#include "core/synth/decompose/gather.h"

#include <algorithm>
#include <utility>

namespace hewn {
namespace {

/// Consecutive items of one kind: [begin, end).
struct Run {
  std::size_t begin = 0, end = 0;
};

using Items = std::vector<TermPtr>;

std::vector<Run> runs_of(const Items& items) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (runs.empty() || items[i]->fills != items[i - 1]->fills) runs.push_back({i, i});
    runs.back().end = i + 1;
  }
  return runs;
}

/// Moves the item so that it comes before what is at `to` now.
void move_item(Items& items, std::size_t from, std::size_t to) {
  const auto at = [&items](std::size_t i) {
    return items.begin() + static_cast<std::ptrdiff_t>(i);
  };
  if (from < to) std::rotate(at(from), at(from) + 1, at(to));
  if (to < from) std::rotate(at(to), at(from), at(from) + 1);
}

class Gathering {
 public:
  Gathering(const SearchSpace& space, DecisionList& list) : space_(space), list_(list) {}

  void run() {
    while (dissolve_one()) {
    }
  }

 private:
  /// Dissolves the first run that can be, short ones first. False when none can.
  bool dissolve_one() {
    const std::vector<Run> runs = runs_of(list_.items);
    std::vector<std::size_t> order(runs.size());
    for (std::size_t r = 0; r < runs.size(); ++r) order[r] = r;
    std::stable_sort(order.begin(), order.end(), [&runs](std::size_t a, std::size_t b) {
      return runs[a].end - runs[a].begin < runs[b].end - runs[b].begin;
    });
    return std::any_of(order.begin(), order.end(),
                       [&](std::size_t r) { return dissolve(runs, r); });
  }

  /// Moves each item of the run to the next run of its kind, outwards or inwards.
  bool dissolve(const std::vector<Run>& runs, std::size_t r) {
    const bool has_outer = r >= 2;
    const bool has_inner = r + 2 < runs.size();
    if (!has_outer && !has_inner) return false;
    Items items = list_.items;
    std::size_t begin = runs[r].begin;
    std::size_t end = runs[r].end;
    while (begin < end) {
      if (has_outer && try_move(items, begin, runs[r - 1].begin)) {
        ++begin;
      } else if (has_inner && try_move(items, begin, runs[r + 1].end)) {
        --end;
      } else {
        return false;
      }
    }
    list_.items = std::move(items);
    return true;
  }

  bool try_move(Items& items, std::size_t from, std::size_t to) const {
    Items moved = items;
    move_item(moved, from, to);
    if (!is_right(space_, moved, list_.base)) return false;
    items = std::move(moved);
    return true;
  }

  const SearchSpace& space_;
  DecisionList& list_;
};

}  // namespace

void gather_runs(const SearchSpace& space, DecisionList& list) {
  if (is_right(space, list.items, list.base)) Gathering(space, list).run();
}

int count_changes(const DecisionList& list) {
  const std::size_t runs = runs_of(list.items).size();
  return runs == 0 ? 0 : static_cast<int>(runs) - 1;
}

}  // namespace hewn
