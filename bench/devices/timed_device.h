#pragma once
/// A device that measures how long its kernels take, without the copies around them.
#include <chrono>

#include "core/compute/device.h"

namespace hewn {

/// Waits for the kernels before and after each launch, which adds some 10 us to each.
class TimedDevice final : public Device {
 public:
  explicit TimedDevice(Device& device) : device_(device) {}
  ~TimedDevice() override {
    if (byte_ != nullptr) device_.release(byte_);
  }

  double kernel_seconds() const { return seconds_; }

  const DeviceInfo& info() const override { return device_.info(); }
  Result<void*> allocate(std::size_t bytes) override { return device_.allocate(bytes); }
  void release(void* memory) override { device_.release(memory); }
  Result<void> upload(void* to, const void* from, std::size_t bytes) override {
    return device_.upload(to, from, bytes);
  }
  Result<void> download(void* to, const void* from, std::size_t bytes) override {
    return device_.download(to, from, bytes);
  }
  Result<void> fill(void* to, unsigned char byte, std::size_t bytes) override {
    return device_.fill(to, byte, bytes);
  }
  Result<void> launch(const Kernel& kernel) override {
    if (const Result<void> done = wait(); !done) return done;
    const auto start = std::chrono::steady_clock::now();
    const Result<void> launched = device_.launch(kernel);
    if (!launched) return launched;
    const Result<void> done = wait();
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return done;
  }

 private:
  /// A download waits for all kernels before it.
  Result<void> wait() {
    if (byte_ == nullptr) {
      auto allocated = device_.allocate(1);
      if (!allocated) return allocated.error();
      byte_ = *allocated;
      if (const Result<void> filled = device_.fill(byte_, 0, 1); !filled) return filled;
    }
    char byte = 0;
    return device_.download(&byte, byte_, 1);
  }

  Device& device_;
  void* byte_ = nullptr;
  double seconds_ = 0;
};

}  // namespace hewn
