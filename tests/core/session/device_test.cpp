// The same tree on every device, and what is said when one is missing or breaks.
#include <algorithm>
#include <string>

#include <doctest/doctest.h>

#include "core/compute/compute.h"
#include "core/session/reconstruct.h"
#include "core/session/report.h"
#include "core/session/session.h"
#include "core/session/tree_file.h"
#include "tests/gpu/failing_device.h"

namespace hewn {
namespace {

using testing::FailingDevice;
using testing::kLost;

Project sample_project() {
  Project project;
  project.mesh = std::string(HEWN_ASSETS "/housing.stl");
  return project;
}

/// The tree as it is written, and what was said meanwhile.
struct Made {
  std::string text;
  std::vector<std::string> warnings;
};

Made made(const Project& project, RunContext run) {
  Made out;
  run.threads = 1;
  run.on_log = [&](const LogEntry& entry) {
    if (entry.severity == Severity::Warning) out.warnings.push_back(entry.message);
  };
  const auto found = reconstruct(project, run);
  REQUIRE(found.has_value());
  TreeFileOptions options;
  options.score = found->score;
  options.warnings = found->warnings;
  const auto file = tree_file(found->tree, "part.scad", options, run);
  REQUIRE(file.has_value());
  out.text = *file;
  return out;
}

RunContext with_device(FailingDevice*& device, int good_calls, DeviceChoice choice) {
  RunContext run;
  run.compute = std::make_shared<Compute>(1, choice, testing::opens(device, good_calls, kLost));
  return run;
}

TEST_CASE("a reconstruction is the same on every device, and on one that breaks in the middle") {
  const Made expected = made(sample_project(), {});
  CHECK(expected.warnings.empty());
  for (const int good_calls : {1000000, 0, 3, 12}) {
    CAPTURE(good_calls);
    FailingDevice* device = nullptr;
    const RunContext run = with_device(device, good_calls, {DeviceChoice::Kind::Cuda, 0});
    const Made found = made(sample_project(), run);
    REQUIRE(device != nullptr);
    CHECK(found.text == expected.text);
    CHECK(device->allocated() == 0);
    if (good_calls == 1000000) {
      CHECK(found.warnings.empty());
      CHECK(run.compute->accelerated_jobs() > 2);
    } else {
      REQUIRE(found.warnings.size() == 1);
      CHECK(found.warnings[0].find("the processor goes on") != std::string::npos);
    }
  }
}

TEST_CASE("the plan's device is used, and auto leaves it to the program") {
  Project project = sample_project();
  FailingDevice* device = nullptr;
  const RunContext run = with_device(device, 1000000, {DeviceChoice::Kind::Cpu, 0});
  static_cast<void>(made(project, run));
  CHECK(run.compute->accelerated_jobs() == 0);
  project.settings.device.kind = static_cast<int>(DeviceChoice::Kind::Cuda);
  static_cast<void>(made(project, run));
  const long jobs = run.compute->accelerated_jobs();
  CHECK(jobs > 2);
  project.settings.device.kind = static_cast<int>(DeviceChoice::Kind::Auto);
  static_cast<void>(made(project, run));
  CHECK(run.compute->accelerated_jobs() == jobs);
}

TEST_CASE("a session tells once that the device which was asked for is not there") {
  RunContext run;
  run.threads = 1;
  run.compute = std::make_shared<Compute>(
      1, DeviceChoice{DeviceChoice::Kind::Cuda, 0}, [](int) -> Result<std::unique_ptr<Device>> {
        return Error{ErrorCode::Device, "no CUDA device 0: no driver"};
      });
  Session session(run);
  session.set_views(false);
  REQUIRE(session.execute(OpenFile{HEWN_ASSETS "/housing.stl"}).has_value());
  session.wait();
  const auto& notices = session.notices();
  const auto count = std::count_if(notices.begin(), notices.end(), [](const Notice& n) {
    return n.severity == Severity::Warning && n.text.find("no driver") != std::string::npos;
  });
  CHECK(count == 1);
  CHECK(session.device() == "processor");
}

TEST_CASE("a session shows the device and what it has done") {
  FailingDevice* device = nullptr;
  RunContext run = with_device(device, 1000000, {DeviceChoice::Kind::Cuda, 0});
  run.threads = 1;
  Session session(run);
  session.set_views(false);
  REQUIRE(session.execute(OpenFile{HEWN_ASSETS "/housing.stl"}).has_value());
  session.wait();
  REQUIRE(session.execute(Reconstruct{}).has_value());
  session.wait();
  CHECK(session.failure().empty());
  CHECK(session.device() ==
        "test card (" + std::to_string(run.compute->accelerated_jobs()) + " jobs)");
  CHECK(run.compute->accelerated_jobs() > 2);
}

}  // namespace
}  // namespace hewn
