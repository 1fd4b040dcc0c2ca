#include "core/compute/compute.h"

#include <charconv>

#include "core/compute/parallel.h"

namespace hewn {
namespace {

void tell(const RunContext& context, Severity severity, std::string message) {
  if (context.on_log) context.on_log({severity, std::move(message), true});
}

}  // namespace

Result<DeviceChoice> DeviceChoice::parse(std::string_view text) {
  if (text == "auto") return DeviceChoice{Kind::Auto, 0};
  if (text == "cpu") return DeviceChoice{Kind::Cpu, 0};
  if (text == "cuda") return DeviceChoice{Kind::Cuda, 0};
  constexpr std::string_view kPrefix = "cuda:";
  if (text.substr(0, kPrefix.size()) == kPrefix) {
    const std::string_view number = text.substr(kPrefix.size());
    int index = -1;
    const auto [end, problem] =
        std::from_chars(number.data(), number.data() + number.size(), index);
    if (problem == std::errc() && end == number.data() + number.size() && index >= 0) {
      return DeviceChoice{Kind::Cuda, index};
    }
  }
  return Error{ErrorCode::InvalidArgument,
               "'" + std::string(text) + "' is no device; give auto, cpu, cuda or cuda:NUMBER"};
}

Compute::Compute(int threads, DeviceChoice choice, OpenDevice open)
    : cpu_(threads), threads_(threads), open_(std::move(open)), usual_(choice), choice_(choice) {}

void Compute::choose(DeviceChoice choice) {
  if (choice.kind == DeviceChoice::Kind::Auto) choice = usual_;
  const std::lock_guard lock(mutex_);
  if (choice == choice_) return;
  const bool is_other_device = choice.index != choice_.index;
  choice_ = choice;
  is_told_ = false;
  if (is_well_ && !is_other_device) return;
  if (device_) retired_.push_back(std::move(device_));
  is_asked_for_ = false;
  is_well_ = false;
}

Result<void> Compute::run(double cpu_seconds, const RunContext& context, const Job& job) {
  if (Device* device = accelerator(cpu_seconds, context)) {
    Result<void> done = job(*device);
    const bool is_its_fault = !done && (done.error().code == ErrorCode::Device ||
                                        done.error().code == ErrorCode::OutOfMemory);
    if (!is_its_fault) {
      const std::lock_guard lock(mutex_);
      ++accelerated_jobs_;
      return done;
    }
    fall_back(done.error(), context);
  }
  return job(cpu_);
}

void Compute::prepare(const RunContext& context) {
  // No job is as short as this: only a demand opens the device.
  accelerator(0, context);
}

std::string Compute::device_name() const {
  const std::lock_guard lock(mutex_);
  return is_well_ ? device_->info().name : cpu_.info().name;
}

long Compute::accelerated_jobs() const {
  const std::lock_guard lock(mutex_);
  return accelerated_jobs_;
}

/// Requires: the lock.
bool Compute::is_wanted(double cpu_seconds) {
  if (choice_.kind != DeviceChoice::Kind::Auto) return choice_.kind == DeviceChoice::Kind::Cuda;
  if (cpu_seconds < kLeastSeconds) return false;  // whatever the number of cores
  const double seconds = cpu_seconds / worker_count(threads_);
  if (seconds < kLeastSeconds) return false;
  if (is_asked_for_) return true;
  missed_seconds_ += seconds;
  return missed_seconds_ >= kOpeningSeconds;
}

Device* Compute::accelerator(double cpu_seconds, const RunContext& context) {
  const std::lock_guard lock(mutex_);
  if (!is_wanted(cpu_seconds)) return nullptr;
  if (!is_asked_for_) {
    is_asked_for_ = true;
    auto opened = open_ ? open_(choice_.index)
                        : Error{ErrorCode::Device, "this build has no support for accelerators"};
    if (opened) {
      device_ = std::move(*opened);
      is_well_ = true;
      tell(context, Severity::Info, "using " + device_->info().name);
    } else if (choice_.kind == DeviceChoice::Kind::Cuda) {
      tell(context, Severity::Warning, opened.error().message + "; the processor does the work");
    }
  }
  return is_well_ ? device_.get() : nullptr;
}

void Compute::fall_back(const Error& reason, const RunContext& context) {
  {
    const std::lock_guard lock(mutex_);
    if (reason.code == ErrorCode::Device) is_well_ = false;
    if (std::exchange(is_told_, true)) return;
  }
  tell(context, Severity::Warning,
       reason.where + ": " + reason.message + "; the processor goes on with the work");
}

std::shared_ptr<Compute> compute_of(const RunContext& run) {
  return run.compute ? run.compute : std::make_shared<Compute>(run.threads);
}

}  // namespace hewn
