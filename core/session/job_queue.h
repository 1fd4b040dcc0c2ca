#pragma once
/// One worker thread that runs jobs in order; their outcomes are handed over on the owner's thread.
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/run_context.h"

namespace hewn {

/// Runs on the owner's thread, in `poll` or `wait`.
using JobCompletion = std::function<void()>;
/// Runs on the worker. What it returns is run on the owner's thread; may be empty. May throw.
using JobWork = std::function<JobCompletion(const RunContext&)>;
/// Told, on the owner's thread, of a job that threw.
using JobFailure = std::function<void(const std::string& job, const std::string& reason)>;
/// Told, on the owner's thread, what a job had to say of the machine.
using MachineNotice = std::function<void(const LogEntry& entry)>;

struct JobStatus {
  int id = 0;
  std::string name;
  bool is_running = false;  ///< false: waiting
  std::string stage;
  double share = 0;    ///< of the stage, [0, 1]
  double seconds = 0;  ///< since it began
};

/// All functions but the work belong to one thread, the owner's.
class JobQueue {
 public:
  /// `base` gives jobs their threads, seed and log; each gets a cancel token of its own. `wake` is
  /// called from the worker, often, whenever there is something new to see.
  explicit JobQueue(RunContext base = {}, std::function<void()> wake = {});
  /// Cancels everything and waits for the worker.
  ~JobQueue();
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;

  void on_failure(JobFailure sink) { on_failure_ = std::move(sink); }
  void on_machine_notice(MachineNotice sink) { on_machine_notice_ = std::move(sink); }
  /// Returns the job's id.
  int add(std::string name, JobWork work);
  /// Has `completion` run on the owner's thread, too, while the job goes on. For the work; from any
  /// thread.
  void post(JobCompletion completion) { hand_over(std::move(completion), false); }
  /// Asks a job to stop, or takes it out of the queue; its completion still runs if it has begun.
  void cancel(int id);
  void cancel_all();
  bool is_idle() const;
  /// Waiting and running jobs in order.
  std::vector<JobStatus> status() const;
  /// Runs the completions of finished jobs; true when there were any. Never blocks on a job.
  bool poll();
  /// Polls until no job waits or runs, those added by completions included; stops them all when
  /// the token of `base` is set.
  void wait();

 private:
  struct Job {
    JobStatus status;
    JobWork work;
    std::shared_ptr<CancelToken> cancel = std::make_shared<CancelToken>();
    std::chrono::steady_clock::time_point start{};
  };
  void run_worker();
  void run_job(const std::shared_ptr<Job>& job);
  void finish(JobCompletion completion);
  void hand_over(JobCompletion completion, bool ends_job);

  RunContext base_;
  std::function<void()> wake_;
  JobFailure on_failure_;
  MachineNotice on_machine_notice_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Job>> waiting_;
  std::shared_ptr<Job> running_;
  std::vector<JobCompletion> finished_;
  int last_id_ = 0;
  bool is_closing_ = false;
  std::thread worker_;  ///< last: starts when everything above is there
};

}  // namespace hewn
