#pragma once
/// What the process returns. Documented in docs/report.md
#include "core/base/result.h"

namespace hewn {

enum class ExitCode : int {
  Done = 0,
  Failed = 1,      ///< no answer within the budget, or something inside broke
  Usage = 2,       ///< an unknown flag, a bad value, a project that makes no sense
  NoInput = 3,     ///< the input is missing or cannot be read
  BadInput = 4,    ///< the input is not what its name says, or holds nothing to work on
  NoOutput = 5,    ///< the output cannot be written
  Cancelled = 130  ///< Ctrl-C or SIGTERM
};

inline ExitCode exit_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::InvalidArgument:
      return ExitCode::Usage;
    case ErrorCode::FileNotFound:
      return ExitCode::NoInput;
    case ErrorCode::Format:
    case ErrorCode::BadMesh:
    case ErrorCode::TooLarge:
      return ExitCode::BadInput;
    case ErrorCode::FileWrite:
      return ExitCode::NoOutput;
    case ErrorCode::Cancelled:
      return ExitCode::Cancelled;
    case ErrorCode::NotFound:
    case ErrorCode::Internal:
    case ErrorCode::OutOfMemory:
    case ErrorCode::Device:
      break;
  }
  return ExitCode::Failed;
}

}  // namespace hewn
