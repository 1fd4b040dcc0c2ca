#pragma once
/// Tells a board how one partition's search goes.
#include <chrono>
#include <string>

#include "core/session/part_board.h"
#include "core/session/reconstruct.h"

namespace hewn {

/// The partition waits from the start on; then it is what it is told to be.
class PartReport {
 public:
  /// `board`: null tells nobody; else it must outlive the report.
  PartReport(PartBoard* board, std::string name);
  void begin();
  void running(const char* stage, double share) const;
  void end(const Result<PartitionResult>& result) const;

 private:
  using Clock = std::chrono::steady_clock;
  void tell(const PartProgress& progress) const;

  PartBoard* board_;
  std::string name_;
  Clock::time_point start_{};
};

}  // namespace hewn
