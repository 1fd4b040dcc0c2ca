#pragma once
/// Faults on demand: an accelerator that is the processor in truth.
#include <memory>
#include <utility>

#include <doctest/doctest.h>

#include "core/compute/compute.h"
#include "core/compute/cpu_device.h"

namespace hewn::testing {

/// An accelerator whose call number `good_calls` (from 0) and all later ones fail.
class FailingDevice final : public Device {
 public:
  FailingDevice(int good_calls, Error error)
      : info_{"test card", true, std::size_t{1} << 24},
        left_(good_calls),
        error_(std::move(error)) {}

  const DeviceInfo& info() const override { return info_; }
  Result<void*> allocate(std::size_t bytes) override {
    if (fails()) return error_;
    ++allocated_;
    return cpu_.allocate(bytes);
  }
  void release(void* memory) override {
    --allocated_;
    cpu_.release(memory);
  }
  Result<void> upload(void* to, const void* from, std::size_t bytes) override {
    return fails() ? Result<void>(error_) : cpu_.upload(to, from, bytes);
  }
  Result<void> download(void* to, const void* from, std::size_t bytes) override {
    return fails() ? Result<void>(error_) : cpu_.download(to, from, bytes);
  }
  Result<void> fill(void* to, unsigned char byte, std::size_t bytes) override {
    return fails() ? Result<void>(error_) : cpu_.fill(to, byte, bytes);
  }
  Result<void> launch(const Kernel& kernel) override {
    return fails() ? Result<void>(error_) : cpu_.launch(kernel);
  }
  int allocated() const { return allocated_; }

 private:
  bool fails() { return left_-- <= 0; }

  DeviceInfo info_;
  CpuDevice cpu_{1};
  int left_;
  Error error_;
  int allocated_ = 0;
};

inline const Error kLost{ErrorCode::Device, "unspecified launch failure", "test card"};
inline const Error kFull{ErrorCode::OutOfMemory, "too little memory on the GPU", "test card"};

/// Opens such a device, which is then found at `opened`.
inline OpenDevice opens(FailingDevice*& opened, int good_calls, const Error& error) {
  return [&opened, good_calls, error](int) -> Result<std::unique_ptr<Device>> {
    auto device = std::make_unique<FailingDevice>(good_calls, error);
    opened = device.get();
    return {std::move(device)};
  };
}

/// Calls `work(compute, run)` with a device that is lost at its first call, then at its second, and
/// so on until it is not lost any more. Each time nothing may be left on it.
template <class Work>
void lose_at_every_call(const Work& work) {
  bool is_done = false;
  for (int good_calls = 0; !is_done; ++good_calls) {
    FailingDevice* device = nullptr;
    Compute compute(1, {DeviceChoice::Kind::Cuda, 0}, opens(device, good_calls, kLost));
    RunContext run;
    is_done = true;
    run.on_log = [&](const LogEntry& entry) { is_done &= entry.severity != Severity::Warning; };
    work(compute, run);
    REQUIRE(device->allocated() == 0);
  }
}

}  // namespace hewn::testing
