#pragma once
/// The choice between the processor and an accelerator, made anew for every job.
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/run_context.h"
#include "core/compute/cpu_device.h"

namespace hewn {

/// What the user asked for.
struct DeviceChoice {
  enum class Kind {
    Auto,  ///< an accelerator where it pays
    Cpu,   ///< never an accelerator
    Cuda   ///< an accelerator for every job that it can do
  };
  Kind kind = Kind::Auto;
  int index = 0;  ///< of the CUDA device

  bool operator==(const DeviceChoice&) const = default;
  /// From "auto", "cpu", "cuda" or "cuda:2". Fails with: InvalidArgument.
  static Result<DeviceChoice> parse(std::string_view text);
};

/// Opens accelerator `index`. Fails with: Device, OutOfMemory.
using OpenDevice = std::function<Result<std::unique_ptr<Device>>(int index)>;

/// Runs jobs on the processor or on an accelerator, which is opened when a job first wants it. A
/// job for which it has too little memory runs on the processor, and so do all later ones when it
/// stops working; the user is told once. Thread-safe; outlives the buffers that jobs keep.
class Compute {
 public:
  /// A job's body: uploads, launches and downloads on the device that it is given. It may be
  /// called again for another device after it has failed on one.
  using Job = std::function<Result<void>(Device&)>;

  /// The processor only.
  explicit Compute(int threads) : Compute(threads, {DeviceChoice::Kind::Cpu, 0}, {}) {}
  Compute(int threads, DeviceChoice choice, OpenDevice open);

  /// Changes the choice for the jobs to come; `Auto` is what the object was made with. A device
  /// that failed is tried again after a change; buffers on the one used before stay valid.
  void choose(DeviceChoice choice);

  /// Does the job. `cpu_seconds`, an estimate of what it takes on one core, decides with
  /// `DeviceChoice::Kind::Auto`: see `kLeastSeconds` and `kOpeningSeconds`.
  /// Fails with: what the job returns on the processor, Cancelled.
  Result<void> run(double cpu_seconds, const RunContext& context, const Job& job);

  /// Opens the accelerator now if the user demands one, so that its absence is told at the start.
  void prepare(const RunContext& context);

  /// The accelerator's name once one is open and well, else "processor".
  std::string device_name() const;
  /// Jobs done on an accelerator so far.
  long accelerated_jobs() const;

  /// Under `Auto`, jobs that take all threads less than this stay on the processor: a launch with
  /// its copies takes 0.05 to 0.4 ms (docs/performance.md).
  static constexpr double kLeastSeconds = 5e-4;
  /// Opening a device takes this once. It is opened when the longer jobs so far have taken as long:
  /// then it has cost at most twice what the better choice would have, whatever is still to come.
  static constexpr double kOpeningSeconds = 0.35;

 private:
  bool is_wanted(double cpu_seconds);
  /// nullptr: none is wanted or none works.
  Device* accelerator(double cpu_seconds, const RunContext& context);
  void fall_back(const Error& reason, const RunContext& context);

  CpuDevice cpu_;
  const int threads_;  ///< of the processor; 0: one per core
  OpenDevice open_;
  mutable std::mutex mutex_;  ///< guards the rest
  const DeviceChoice usual_;
  DeviceChoice choice_;
  bool is_asked_for_ = false;  ///< opening was tried
  bool is_told_ = false;       ///< the user knows that the processor stands in
  bool is_well_ = false;
  long accelerated_jobs_ = 0;
  double missed_seconds_ = 0;  ///< of longer jobs that the processor has done under `Auto`
  std::unique_ptr<Device> device_;
  std::vector<std::unique_ptr<Device>> retired_;  ///< jobs may still hold buffers on them
};

/// `run.compute`, or the processor with `run.threads`.
std::shared_ptr<Compute> compute_of(const RunContext& run);

}  // namespace hewn
