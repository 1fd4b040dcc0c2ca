#pragma once
/// Where kernels run: the processor, or an accelerator with memory of its own.
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/result.h"

namespace hewn {

/// Any kernel; core/compute/kernels/kernels.h has them, for those who launch some.
struct Kernel;

struct DeviceInfo {
  std::string name;             ///< as its maker calls it
  bool is_accelerator = false;  ///< memory of its own, reached by copies
  /// Bytes that one job should hold there; larger problems go through in parts.
  std::size_t memory_budget = 0;
};

/// Thread-safe. Errors are `OutOfMemory` and `Device`; after the latter the device is of no more
/// use.
class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  virtual const DeviceInfo& info() const = 0;
  /// Memory aligned for any type, not cleared. Requires: `bytes > 0`.
  virtual Result<void*> allocate(std::size_t bytes) = 0;
  virtual void release(void* memory) = 0;
  virtual Result<void> upload(void* to, const void* from, std::size_t bytes) = 0;
  /// Waits for the kernels launched before by this thread, and reports their failure.
  virtual Result<void> download(void* to, const void* from, std::size_t bytes) = 0;
  virtual Result<void> fill(void* to, unsigned char byte, std::size_t bytes) = 0;
  /// All pointers in the kernel are to memory of this device. May return before it has run;
  /// kernels and copies of one thread run in order.
  virtual Result<void> launch(const Kernel& kernel) = 0;
};

/// Memory of a device, which must outlive it. Empty by default.
template <class T>
class DeviceBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  DeviceBuffer() = default;
  DeviceBuffer(Device& device, T* data, std::size_t size)
      : device_(&device), data_(data), size_(size) {}
  DeviceBuffer(DeviceBuffer&& other) noexcept { swap(other); }
  DeviceBuffer& operator=(DeviceBuffer&& other) noexcept {
    DeviceBuffer taken(std::move(other));
    swap(taken);
    return *this;
  }
  ~DeviceBuffer() {
    if (data_ != nullptr) device_->release(data_);
  }

  T* data() const { return data_; }  ///< an address on the device
  std::size_t size() const { return size_; }
  /// nullptr: empty
  const Device* device() const { return device_; }

 private:
  void swap(DeviceBuffer& other) {
    std::swap(device_, other.device_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }
  Device* device_ = nullptr;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Allocations, copies and launches in a row. After the first failure the rest does nothing, so
/// that one look at `result()` at the end is enough. For one thread.
class DeviceJob {
 public:
  explicit DeviceJob(Device& device) : device_(&device) {}

  bool has_failed() const { return error_.has_value(); }
  Result<void> result() const { return error_ ? Result<void>(*error_) : Result<void>(); }

  /// Not cleared. Empty after a failure, or for `size == 0`.
  template <class T>
  DeviceBuffer<T> allocate(std::size_t size) {
    if (error_ || size == 0) return {};
    auto memory = device_->allocate(size * sizeof(T));
    if (!memory) {
      error_ = memory.error();
      return {};
    }
    return DeviceBuffer<T>(*device_, static_cast<T*>(*memory), size);
  }
  template <class T>
  DeviceBuffer<T> allocate_filled(std::size_t size, unsigned char byte) {
    DeviceBuffer<T> buffer = allocate<T>(size);
    if (buffer.size() > 0) keep(device_->fill(buffer.data(), byte, size * sizeof(T)));
    return buffer;
  }
  template <class T>
  DeviceBuffer<T> upload(std::span<const T> from) {
    DeviceBuffer<T> buffer = allocate<T>(from.size());
    if (buffer.size() > 0) keep(device_->upload(buffer.data(), from.data(), from.size_bytes()));
    return buffer;
  }
  /// Requires: `to.size() <= from.size()`, unless something has failed.
  template <class T>
  void download(const DeviceBuffer<T>& from, std::span<T> to) {
    download(from.data(), to);
  }
  /// The same from an address on the device.
  template <class T>
  void download(const T* from, std::span<T> to) {
    if (!error_ && !to.empty()) keep(device_->download(to.data(), from, to.size_bytes()));
  }
  void launch(const Kernel& kernel) {
    if (!error_) keep(device_->launch(kernel));
  }

 private:
  void keep(const Result<void>& done) {
    if (!done && !error_) error_ = done.error();
  }
  Device* device_;
  std::optional<Error> error_;
};

}  // namespace hewn
