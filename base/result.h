#pragma once

#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "base/check.h"

namespace orthonav {

/// What kind of thing went wrong, for callers that branch on it.
enum class ErrorCode {
  kInvalid,      ///< input or arguments that can't be used as they are
  kNotFound,     ///< no such file, device or name
  kIo,           ///< the file system refused to read or write
  kUnavailable,  ///< a device that is not there now, or not yet; asking again may help
  kLost,         ///< a device, session or connection that is gone for good
};

struct Reason;  // base/reason.h

/// What went wrong, in one line a user can act on: what, where, value, limit.
struct Error {
  std::string message;
  ErrorCode code = ErrorCode::kInvalid;
  /// Of a refusal that a wearer may read: what the message says, as data. Null: it is English
  /// alone.
  std::shared_ptr<const Reason> reason = nullptr;
};

/// A value, or the reason why there is none. Reading the absent one ends the program, in release
/// builds too.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}      // NOLINT
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}  // NOLINT

  [[nodiscard]] bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }
  [[nodiscard]] T& value() & {
    ORTHONAV_CHECK(ok() && "a result was read that is an error");
    return *std::get_if<0>(&content_);
  }
  [[nodiscard]] const T& value() const& {
    ORTHONAV_CHECK(ok() && "a result was read that is an error");
    return *std::get_if<0>(&content_);
  }
  [[nodiscard]] T&& value() && { return std::move(value()); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  [[nodiscard]] const Error& error() const {
    ORTHONAV_CHECK(!ok() && "an error was read that is a result");
    return *std::get_if<1>(&content_);
  }

 private:
  std::variant<T, Error> content_;
};

/// Success without a value, or an Error.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : failed_(true), error_(std::move(error)) {}  // NOLINT

  [[nodiscard]] bool ok() const { return !failed_; }
  explicit operator bool() const { return ok(); }
  [[nodiscard]] const Error& error() const {
    ORTHONAV_CHECK(failed_ && "an error was read that is a success");
    return error_;
  }

 private:
  bool failed_ = false;
  Error error_;
};

}  // namespace orthonav
