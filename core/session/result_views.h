#pragma once
/// The views of a session's results: made by jobs, kept while somebody may look again.
#include <functional>
#include <memory>
#include <vector>

#include "core/session/job_queue.h"
#include "core/session/plan_search.h"

namespace hewn {

/// Belongs to the thread that owns the job queues; must outlive their jobs.
class ResultViews {
 public:
  using SharedView = std::shared_ptr<const ResultView>;
  /// Told of views that cannot be made, but for those that were stopped.
  explicit ResultViews(std::function<void(const Error&)> report) : report_(std::move(report)) {}

  /// Null while there is none.
  SharedView find(const SharedResult& result) const;
  /// Keeps a view that somebody else made.
  void put(const SharedResult& result, SharedView view);
  /// Has a view made, unless there is one or it is on its way or cannot be made. What was wanted
  /// last is kept longest. Returns the job's id; 0: none was started.
  int want(const SharedResult& result, JobQueue& jobs);
  /// Forgets the view, or all, that somebody has stopped or that could not be made.
  void drop_unmade(const SharedResult& result);
  void drop_unmade();
  void clear() { entries_.clear(); }

 private:
  struct Entry {
    SharedResult result;
    SharedView view;  ///< null: on its way, or it cannot be made
  };
  std::vector<Entry>::iterator entry_of(const SharedResult& result);
  void add(Entry entry);

  std::function<void(const Error&)> report_;
  std::vector<Entry> entries_;  ///< the one that was wanted last comes last
};

}  // namespace hewn
