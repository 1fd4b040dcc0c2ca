#pragma once
/// How long frames took.
#include <chrono>
#include <string>
#include <vector>

namespace hewn {

class FrameStats {
 public:
  using Clock = std::chrono::steady_clock;

  void begin();
  /// `is_moving`: the camera is being turned; `is_busy`: a job runs.
  void end(bool is_moving, bool is_busy);
  /// One line of JSON: counts, means and largest values in milliseconds, and the processor time
  /// that a frame takes on all threads together, which other programs on the machine do not change.
  /// `own_max_ms`: the most that the window's own thread has worked in one frame; jobs, which run
  /// on other threads, have no part in it.
  std::string summary() const;

 private:
  struct Frames {
    std::vector<double> ms, cpu_ms, own_ms;
    std::string text() const;
  };
  Frames all_, moving_, busy_;
  Clock::time_point start_{};
  double cpu_start_ms_ = 0, own_start_ms_ = 0;
};

}  // namespace hewn
