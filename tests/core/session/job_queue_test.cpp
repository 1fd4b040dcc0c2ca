#include "core/session/job_queue.h"

#include <stdexcept>
#include <thread>

#include <doctest/doctest.h>

namespace hewn {
namespace {

TEST_CASE("completions run on the owner's thread, in order") {
  JobQueue queue;
  std::vector<int> order;
  const auto owner = std::this_thread::get_id();
  std::thread::id worker;
  for (int i = 0; i < 5; ++i) {
    queue.add("job", [&order, &worker, owner, i](const RunContext&) -> JobCompletion {
      worker = std::this_thread::get_id();
      return [&order, owner, i] {
        CHECK(std::this_thread::get_id() == owner);
        order.push_back(i);
      };
    });
  }
  queue.wait();
  CHECK(order == std::vector<int>{0, 1, 2, 3, 4});
  CHECK(worker != owner);
  CHECK(queue.is_idle());
}

TEST_CASE("a completion may add a job, and wait covers it") {
  JobQueue queue;
  bool done = false;
  queue.add("first", [&](const RunContext&) -> JobCompletion {
    return [&] {
      queue.add("second", [&](const RunContext&) -> JobCompletion { return [&] { done = true; }; });
    };
  });
  queue.wait();
  CHECK(done);
}

TEST_CASE("a job that throws is reported and the next one runs") {
  JobQueue queue;
  std::string reported;
  queue.on_failure([&](const std::string& job, const std::string& why) { reported = job + why; });
  bool ran = false;
  queue.add("bad", [](const RunContext&) -> JobCompletion { throw std::runtime_error(": oops"); });
  queue.add("good", [&](const RunContext&) -> JobCompletion { return [&] { ran = true; }; });
  queue.wait();
  CHECK(reported == "bad: oops");
  CHECK(ran);
}

TEST_CASE("cancelling stops the running job and drops the waiting ones") {
  JobQueue queue;
  std::atomic<bool> started = false;
  bool second_ran = false;
  queue.add("long", [&](const RunContext& run) -> JobCompletion {
    started = true;
    while (!run.is_cancelled()) std::this_thread::yield();
    return {};
  });
  const int second = queue.add("never", [&](const RunContext&) -> JobCompletion {
    second_ran = true;
    return {};
  });
  while (!started) std::this_thread::yield();
  CHECK(queue.status().size() == 2);
  CHECK(queue.status()[0].is_running);
  queue.cancel(second);
  CHECK(queue.status().size() == 1);
  queue.cancel_all();
  queue.wait();
  CHECK_FALSE(second_ran);
}

TEST_CASE("progress of the running job can be seen while it runs") {
  std::atomic<int> wakes = 0;
  std::atomic<bool> reported = false;
  std::atomic<bool> seen = false;
  std::optional<JobQueue> queue(std::in_place, RunContext{}, [&] { ++wakes; });
  queue->add("steps", [&](const RunContext& run) -> JobCompletion {
    run.report("half way", 0.5);
    reported = true;
    while (!seen) std::this_thread::yield();
    return {};
  });
  while (!reported) std::this_thread::yield();
  const std::vector<JobStatus> jobs = queue->status();
  seen = true;
  REQUIRE(jobs.size() == 1);
  CHECK(jobs[0].stage == "half way");
  CHECK(jobs[0].share == 0.5);
  queue->wait();
  queue.reset();      // the last wake may come after the job's completion
  CHECK(wakes >= 2);  // the report and the end
}

}  // namespace
}  // namespace hewn
