#pragma once
/// The working session behind a window or a replayed log: one document with its history, jobs,
/// results, notices and the record of everything done. Knows no user interface.
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/session/command.h"
#include "core/session/display_mesh.h"
#include "core/session/found_partitions.h"
#include "core/session/history.h"
#include "core/session/job_queue.h"
#include "core/session/journal.h"
#include "core/session/part_board.h"
#include "core/session/plan_search.h"
#include "core/session/result_store.h"
#include "core/session/result_views.h"

namespace hewn {

/// One thread owns a session; only the jobs run elsewhere.
class Session {
 public:
  /// `base` gives the jobs their thread count. `wake` is called from the worker when there is
  /// something new to see.
  explicit Session(const RunContext& base = {}, std::function<void()> wake = {});

  /// Carries a command out and records it. Work that takes time becomes a job.
  /// Fails with: InvalidArgument and what reading the file fails with; nothing has changed then,
  /// nothing is recorded, and the notices say why.
  Result<void> execute(const SessionCommand& command);

  /// Carry out edits of the groups (cuts, merges) on a worker of their own. They succeed for now;
  /// what comes after them waits its turn, and the notices tell of a failure. Off unless told
  /// otherwise: runs without a window want the outcome at once.
  void set_background_edits(bool is_on) { has_background_edits_ = is_on; }
  bool is_editing() const { return is_editing_; }

  /// Opens a copy that a crash left behind; the plan counts as not saved.
  Result<void> recover(const std::filesystem::path& copy);

  /// Puts what jobs have finished in place; true when something changed.
  bool poll();
  /// Polls until all jobs are done. For runs without a window.
  void wait();
  void cancel_jobs();
  /// Stops the search of one partition. The others go on, and what they find is there when the plan
  /// is searched again.
  void stop_partition(const std::string& name);
  /// Whether results are prepared for drawing; on unless told otherwise.
  void set_views(bool wants_views) { wants_views_ = wants_views; }
  std::vector<JobStatus> jobs() const;
  /// "processor", or a GPU's name with the number of jobs that it has done.
  std::string device() const;
  bool is_busy() const { return !jobs_.is_idle() || !edits_.is_idle(); }

  const Document& document() const { return history_.current(); }
  const History& history() const { return history_; }
  /// The project file that was opened or saved last; empty for a mesh.
  const std::filesystem::path& project_path() const { return project_path_; }
  /// Whether the plan differs from what was opened or saved last.
  bool is_modified() const;

  /// Reconstruct after every change of the plan. No command: never part of a log.
  void set_live(bool is_live);
  bool is_live() const { return is_live_; }
  /// Searches again with other settings and seeds, so that there is a choice of trees.
  void search_variants();

  /// All results for the mesh, oldest first.
  const std::vector<SharedResult>& results() const { return results_.all(); }
  /// The result for the plan as it is; null when there is none yet.
  SharedResult current_result() const;
  /// The current result; while the plan has none, the best that its search has found on the way, or
  /// else the last one of another plan. Null when there is none at all.
  SharedResult shown_result() const;
  /// Whether the shown result is one that was found on the way: a better one may follow.
  bool shows_draft() const;
  /// Looks at another result for now, as at a point of the Pareto front; null: no more. No command.
  void preview(const SharedResult& result);
  bool is_previewing() const { return preview_ != nullptr; }
  /// The result that is looked at, as soon as it can be drawn; else the shown one.
  SharedResult viewed_result() const;
  /// What is drawn of the viewed result; null until its job is done.
  std::shared_ptr<const ResultView> result_view() const;
  /// The partitions of the document with their groups; see `partition_views`.
  const std::vector<PartitionView>& partitions() const;
  /// How far the partitions of the present plan have got: of the search that runs or ran last, or
  /// of the result that is there. Empty when the plan was not searched yet.
  std::vector<PartProgress> partition_progress() const;
  /// Why the last search for the present plan failed; empty when it did not.
  const std::string& failure() const { return failure_; }

  /// Triangles and lines of the document's mesh; null while there is none.
  std::shared_ptr<const DisplayMesh> display();

  const std::vector<Notice>& notices() const { return journal_.notices(); }
  void notify(Severity severity, std::string text);
  void dismiss(std::size_t notice);
  /// What was done and said, oldest first: commands, and notices that were dismissed, too.
  const std::vector<Notice>& journal() const { return journal_.entries(); }
  /// Set by errors since the last call; a replay stops there.
  bool take_failed() { return journal_.take_failed(); }

  /// Everything done so far, one command a line; `replay` reads it.
  const std::string& log() const { return journal_.log(); }
  /// Grows with every change of document, results or notices.
  std::uint64_t revision() const { return revision_; }

 private:
  Result<void> check_edit(const EditLiteral& command) const;
  Result<void> carry_out(const SessionCommand& command);
  Result<void> edit(const SessionCommand& command);
  void start_edit(const SessionCommand& command);
  void finish_edit(const SessionCommand& command, std::uint64_t edition, Result<Document> next);
  void drop_edit();
  Result<void> open(const std::filesystem::path& path);
  Result<void> save(const std::filesystem::path& path);
  Result<void> export_tree(const ExportTree& command);
  Result<void> start_search();
  void plan_changed();
  void start_reading();
  void adopt_source(const Project& project, Result<Document> read);
  void adopt_draft(const DrawnResult& draft);
  void adopt_result(const DrawnResult& drawn);
  SharedResult unedited_result() const;
  int add_search(const Project& project, const std::string& source);
  void report(const Error& error);
  const std::string& plan() const { return derived().plan; }
  const std::string& key() const { return derived().key; }

  /// What is derived from the document again and again, kept until it changes.
  struct Derived {
    std::uint64_t edition = 0;
    std::string plan;  ///< `plan_text`
    std::string key;   ///< `search_key`
    std::vector<PartitionView> partitions;
  };
  const Derived& derived() const;

  std::shared_ptr<Compute> compute_;
  History history_;
  mutable Derived derived_;
  std::filesystem::path project_path_;
  std::string saved_plan_;
  bool is_live_ = false;
  ResultStore results_;
  SharedResult last_result_;
  DrawnResult draft_;  ///< of the search that runs
  ResultViews views_{[this](const Error& error) { report(error); }};
  SharedResult preview_;
  int preview_job_ = 0;
  bool wants_views_ = true;
  std::string failure_;
  int search_job_ = 0;
  std::shared_ptr<FoundPartitions> found_ = std::make_shared<FoundPartitions>();  ///< in this mesh
  std::shared_ptr<PartBoard> board_;  ///< of the last search for a plan
  std::string board_key_;
  std::string searched_key_;
  std::vector<int> variant_jobs_;
  std::shared_ptr<const PreparedMesh> display_of_;
  std::shared_ptr<const DisplayMesh> display_;
  Journal journal_;
  bool has_background_edits_ = false;
  bool is_editing_ = false;
  int edit_ = 0;                        ///< number of the edit that counts
  std::deque<SessionCommand> waiting_;  ///< for the edit to be done
  std::uint64_t revision_ = 1;
  JobQueue edits_;
  JobQueue jobs_;  ///< the queues come last: their workers must end before the rest goes
};

}  // namespace hewn
