#pragma once
/// The outcome of an operation that is expected to fail at times (bad file, cancelled, disk full).
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace hewn {

enum class ErrorCode {
  InvalidArgument,  ///< an option or a request makes no sense
  FileNotFound,     ///< nothing is at the path, or it cannot be opened for reading
  FileWrite,        ///< the file could not be written: read-only folder, full disk
  Format,           ///< the file's content is not what its name or header says
  BadMesh,          ///< the mesh holds nothing that can be worked on
  TooLarge,         ///< a stated limit is exceeded
  Cancelled,        ///< the user stopped the job
  NotFound,         ///< no answer exists within the budget
  Internal,         ///< a third-party library failed
  OutOfMemory,      ///< of this machine or of a device
  Device,           ///< an accelerator is missing, too old, or stopped working
};

/// What is wrong, where (file, line, element) and what to do about it.
struct Error {
  ErrorCode code = ErrorCode::Internal;
  std::string message;
  std::string where = {};
};

/// A `T` or an `Error`. Member names follow C++23's `std::expected`.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: implicit
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit

  bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }
  /// Requires: `has_value()`.
  T& value() & { return *std::get_if<0>(&state_); }
  const T& value() const& { return *std::get_if<0>(&state_); }
  T&& value() && { return std::move(*std::get_if<0>(&state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  /// Requires: `!has_value()`.
  const Error& error() const { return *std::get_if<1>(&state_); }

 private:
  std::variant<T, Error> state_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT: implicit

  bool has_value() const { return !error_; }
  explicit operator bool() const { return has_value(); }
  /// Requires: `!has_value()`.
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace hewn
