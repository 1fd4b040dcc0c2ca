/// What happens when an accelerator is missing, too small or breaks in the middle of a job.
#include <doctest/doctest.h>

#include "core/compute/compute.h"
#include "core/compute/signatures.h"
#include "core/compute/tree_batch.h"
#include "gpu/cuda_device.h"
#include "tests/gpu/failing_device.h"
#include "tests/gpu/test_device.h"

namespace hewn {
namespace {

using testing::FailingDevice;
using testing::kFull;
using testing::kLost;
using testing::opens;

/// A run that keeps its warnings.
struct Run {
  Run() {
    context.threads = 1;
    context.on_log = [this](const LogEntry& entry) {
      if (entry.severity == Severity::Warning) warnings.push_back(entry.message);
    };
  }
  RunContext context;
  std::vector<std::string> warnings;
};

/// All that kernels do, in one job each, on fixed data.
struct Work {
  explicit Work(Run& run) : context(run.context) {
    Rng rng(21);
    surfaces = testing::random_surfaces(90, rng);
    points = testing::random_points(1500, rng);
  }

  /// Everything computed, for comparison.
  std::vector<Word> outcome(Compute& compute) const {
    std::vector<Word> out(points.size() * 2, 0);
    const auto sides = [&](Device& device) {
      std::fill(out.begin(), out.end(), 0);
      return add_signatures(device, surfaces, points, 0, {out, 2}, context);
    };
    REQUIRE(compute.run(1, context, sides).has_value());
    std::vector<int> numbers;
    const auto number = [&](Device& device) -> Result<void> {
      auto found = number_distinct_rows(device, out, 2);
      if (!found) return found.error();
      numbers = std::move(*found);
      return {};
    };
    REQUIRE(compute.run(1, context, number).has_value());
    std::vector<Word> column(padded_words(points.size()), 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (numbers[i] % 2 == 0) set_bit(column.data(), i);
    }
    MeasuredRows rows(points.size(), {column}, column);
    TreeBatch batch;
    batch.add(std::vector<Token>{0, kComplementToken, 0, kUnionToken});
    std::vector<TreeMeasures> measured(1);
    const auto measure = [&](Device& device) {
      return rows.measure(device, batch, measured, context);
    };
    REQUIRE(compute.run(1, context, measure).has_value());
    out.insert(out.end(), column.begin(), column.end());
    out.push_back(static_cast<Word>(measured[0].held));
    return out;
  }

  const RunContext& context;
  std::vector<SurfaceForm> surfaces;
  std::vector<Vec3> points;
};

TEST_CASE("a device lost at any call leaves the same results and one warning") {
  Run plain;
  Compute processor(1);
  const std::vector<Word> expected = Work(plain).outcome(processor);
  // The whole work makes fewer calls than the last number here: then there is nothing to tell.
  int most_calls = 0;
  for (int good_calls = 0; most_calls == 0; ++good_calls) {
    Run run;
    FailingDevice* device = nullptr;
    Compute compute(1, {DeviceChoice::Kind::Cuda, 0}, opens(device, good_calls, kLost));
    REQUIRE(Work(run).outcome(compute) == expected);
    REQUIRE(device->allocated() == 0);
    if (run.warnings.empty()) {
      most_calls = good_calls;
      CHECK(compute.device_name() == "test card");
      break;
    }
    REQUIRE(run.warnings.size() == 1);
    REQUIRE(run.warnings[0].find("test card: unspecified launch failure") != std::string::npos);
    REQUIRE(compute.device_name() == "processor");
  }
  CHECK(most_calls > 20);
}

TEST_CASE("a device with too little memory for a job is told once and tried again") {
  Run run;
  FailingDevice* device = nullptr;
  Compute compute(1, {DeviceChoice::Kind::Cuda, 0}, opens(device, 3, kFull));
  Compute processor(1);
  CHECK(Work(run).outcome(compute) == Work(run).outcome(processor));
  REQUIRE(run.warnings.size() == 1);
  CHECK(run.warnings[0].find("too little memory") != std::string::npos);
  CHECK(compute.device_name() == "test card");
}

TEST_CASE("without a driver the processor works, and a demanded device is missed aloud") {
  const OpenDevice none = [](int) -> Result<std::unique_ptr<Device>> {
    return Error{ErrorCode::Device, "no CUDA device 0: no driver"};
  };
  Run plain;
  Compute processor(1);
  const std::vector<Word> expected = Work(plain).outcome(processor);
  Run demanded;
  Compute cuda(1, {DeviceChoice::Kind::Cuda, 0}, none);
  cuda.prepare(demanded.context);
  CHECK(demanded.warnings.size() == 1);
  CHECK(Work(demanded).outcome(cuda) == expected);
  CHECK(demanded.warnings.size() == 1);
  Run automatic;
  Compute either(1, {DeviceChoice::Kind::Auto, 0}, none);
  CHECK(Work(automatic).outcome(either) == expected);
  CHECK(automatic.warnings.empty());
}

TEST_CASE("a device is opened when jobs have taken as long, and then does all but small ones") {
  Run run;
  FailingDevice* device = nullptr;
  Compute automatic(1, {DeviceChoice::Kind::Auto, 0}, opens(device, 1000, kLost));
  const auto on_accelerator = [&](double seconds) {
    bool is_accelerator = false;
    REQUIRE(automatic
                .run(seconds, run.context,
                     [&](Device& d) -> Result<void> {
                       is_accelerator = d.info().is_accelerator;
                       return {};
                     })
                .has_value());
    return is_accelerator;
  };
  constexpr double kSmall = Compute::kLeastSeconds / 2;
  constexpr double kLarge = Compute::kOpeningSeconds / 2.5;
  const double enough_small_ones = 2 * Compute::kOpeningSeconds / kSmall;
  for (double i = 0; i < enough_small_ones; ++i) REQUIRE_FALSE(on_accelerator(kSmall));
  CHECK_FALSE(on_accelerator(kLarge));
  CHECK_FALSE(on_accelerator(kLarge));
  CHECK(device == nullptr);  // not even opened
  CHECK(on_accelerator(kLarge));
  CHECK(on_accelerator(2 * Compute::kLeastSeconds));
  CHECK_FALSE(on_accelerator(kSmall));
}

TEST_CASE("a change of choice takes effect with the next job, and auto is what it was at first") {
  Run run;
  std::vector<int> opened;
  const OpenDevice open = [&](int index) -> Result<std::unique_ptr<Device>> {
    opened.push_back(index);
    std::unique_ptr<Device> device = std::make_unique<FailingDevice>(1000, kLost);
    return device;
  };
  Compute compute(1, {DeviceChoice::Kind::Cpu, 0}, open);
  const auto is_accelerated = [&] {
    bool is_accelerator = false;
    const auto look = [&](Device& d) -> Result<void> {
      is_accelerator = d.info().is_accelerator;
      return {};
    };
    REQUIRE(compute.run(1, run.context, look).has_value());
    return is_accelerator;
  };
  CHECK_FALSE(is_accelerated());
  compute.choose({DeviceChoice::Kind::Cuda, 2});
  CHECK(is_accelerated());
  compute.choose({DeviceChoice::Kind::Cuda, 2});
  CHECK(is_accelerated());
  compute.choose({DeviceChoice::Kind::Cuda, 0});
  CHECK(is_accelerated());
  CHECK(opened == std::vector<int>{2, 0});
  CHECK(compute.accelerated_jobs() == 3);
  compute.choose({DeviceChoice::Kind::Auto, 0});
  CHECK_FALSE(is_accelerated());
  CHECK(compute.accelerated_jobs() == 3);
}

TEST_CASE("a lost device is tried again once the user has chosen anew") {
  Run run;
  FailingDevice* device = nullptr;
  Compute compute(1, {DeviceChoice::Kind::Cuda, 0}, opens(device, 0, kLost));
  static_cast<void>(Work(run).outcome(compute));
  CHECK(run.warnings.size() == 1);
  compute.choose({DeviceChoice::Kind::Cpu, 0});
  static_cast<void>(Work(run).outcome(compute));
  CHECK(run.warnings.size() == 1);
  compute.choose({DeviceChoice::Kind::Cuda, 0});
  static_cast<void>(Work(run).outcome(compute));
  CHECK(run.warnings.size() == 2);
}

TEST_CASE("a failure that is not the device's own is passed on") {
  Run run;
  FailingDevice* device = nullptr;
  Compute compute(1, {DeviceChoice::Kind::Cuda, 0}, opens(device, 1000, kLost));
  int calls = 0;
  const auto done = compute.run(1, run.context, [&](Device&) -> Result<void> {
    ++calls;
    return RunContext::cancelled();
  });
  REQUIRE_FALSE(done.has_value());
  CHECK(done.error().code == ErrorCode::Cancelled);
  CHECK(calls == 1);
  CHECK(run.warnings.empty());
}

TEST_CASE("a stop is seen between the parts of a job") {
  Rng rng(22);
  Run run;
  run.context.cancel->cancel();
  const auto surfaces = testing::random_surfaces(2, rng);
  const auto points = testing::random_points(10, rng);
  std::vector<Word> columns(2 * padded_words(10), 0);
  CpuDevice device(1);
  const auto done = fill_columns(device, surfaces, points, columns, run.context);
  REQUIRE_FALSE(done.has_value());
  CHECK(done.error().code == ErrorCode::Cancelled);
}

TEST_CASE("device names are read in full or not at all") {
  CHECK(DeviceChoice::parse("auto")->kind == DeviceChoice::Kind::Auto);
  CHECK(DeviceChoice::parse("cpu")->kind == DeviceChoice::Kind::Cpu);
  CHECK(DeviceChoice::parse("cuda")->index == 0);
  CHECK(DeviceChoice::parse("cuda:12")->index == 12);
  for (const char* bad : {"", "gpu", "cuda:", "cuda:-1", "cuda:1x", "cuda:99999999999", "CPU"}) {
    const auto parsed = DeviceChoice::parse(bad);
    REQUIRE_FALSE(parsed.has_value());
    CHECK(parsed.error().code == ErrorCode::InvalidArgument);
  }
}

TEST_CASE("a GPU that does not exist is named in the error") {
  const auto opened = open_cuda_device(4096);
  REQUIRE_FALSE(opened.has_value());
  CHECK(opened.error().code == ErrorCode::Device);
  CHECK(opened.error().message.find("CUDA") != std::string::npos);
}

}  // namespace
}  // namespace hewn
