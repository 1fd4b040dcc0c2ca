#include "core/session/job_queue.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <sys/resource.h>

namespace hewn {

JobQueue::JobQueue(RunContext base, std::function<void()> wake)
    : base_(std::move(base)), wake_(std::move(wake)), worker_([this] { run_worker(); }) {}

JobQueue::~JobQueue() {
  cancel_all();
  {
    const std::lock_guard lock(mutex_);
    is_closing_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

int JobQueue::add(std::string name, JobWork work) {
  auto job = std::make_shared<Job>();
  job->status.name = std::move(name);
  job->work = std::move(work);
  {
    const std::lock_guard lock(mutex_);
    job->status.id = ++last_id_;
    waiting_.push_back(job);
  }
  changed_.notify_all();
  return job->status.id;
}

void JobQueue::cancel(int id) {
  const std::lock_guard lock(mutex_);
  if (running_ && running_->status.id == id) running_->cancel->cancel();
  std::erase_if(waiting_, [id](const auto& job) { return job->status.id == id; });
}

void JobQueue::cancel_all() {
  const std::lock_guard lock(mutex_);
  waiting_.clear();
  if (running_) running_->cancel->cancel();
}

bool JobQueue::is_idle() const {
  const std::lock_guard lock(mutex_);
  return !running_ && waiting_.empty() && finished_.empty();
}

std::vector<JobStatus> JobQueue::status() const {
  const std::lock_guard lock(mutex_);
  std::vector<JobStatus> out;
  if (running_) {
    out.push_back(running_->status);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - running_->start;
    out.back().seconds = passed.count();
  }
  for (const auto& job : waiting_) out.push_back(job->status);
  return out;
}

bool JobQueue::poll() {
  std::vector<JobCompletion> ready;
  {
    const std::lock_guard lock(mutex_);
    ready.swap(finished_);
  }
  for (const JobCompletion& completion : ready) {
    if (completion) completion();
  }
  return !ready.empty();
}

void JobQueue::wait() {
  while (!is_idle()) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return !finished_.empty() || (!running_ && waiting_.empty()); });
    }
    poll();
  }
}

void JobQueue::run_worker() {
  // Behind a window, what is drawn comes first. On Linux this is of the thread and those it starts.
  constexpr int kStepBack = 5;
  if (wake_)
    static_cast<void>(::setpriority(PRIO_PROCESS, 0, ::getpriority(PRIO_PROCESS, 0) + kStepBack));
  for (;;) {
    std::shared_ptr<Job> job;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return is_closing_ || !waiting_.empty(); });
      if (is_closing_) return;
      job = waiting_.front();
      waiting_.pop_front();
      job->status.is_running = true;
      job->start = std::chrono::steady_clock::now();
      running_ = job;
    }
    run_job(job);
  }
}

void JobQueue::run_job(const std::shared_ptr<Job>& job) {
  RunContext run = base_;
  run.cancel = job->cancel;
  run.on_progress = [this, &job](const char* stage, double share) {
    {
      const std::lock_guard lock(mutex_);
      job->status.stage = stage;
      job->status.share = share;
    }
    if (wake_) wake_();
  };
  run.on_log = [this](const LogEntry& entry) {
    if (base_.on_log) base_.on_log(entry);
    if (!entry.is_about_machine) return;
    hand_over(
        [this, entry] {
          if (on_machine_notice_) on_machine_notice_(entry);
        },
        false);
  };
  std::string reason;
  try {
    finish(job->work(run));
    return;
  } catch (const std::exception& thrown) {
    reason = thrown.what();
  } catch (...) {
    reason = "unknown exception";
  }
  finish([this, name = job->status.name, reason] {
    if (on_failure_) on_failure_(name, reason);
  });
}

void JobQueue::finish(JobCompletion completion) { hand_over(std::move(completion), true); }

void JobQueue::hand_over(JobCompletion completion, bool ends_job) {
  {
    const std::lock_guard lock(mutex_);
    finished_.push_back(std::move(completion));
    if (ends_job) running_ = nullptr;
  }
  changed_.notify_all();
  if (wake_) wake_();
}

}  // namespace hewn
