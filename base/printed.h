#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace orthonav {

/// One value to be printed, with its type.
struct PrintedValue {
  enum class Kind { kSigned, kUnsigned, kReal, kText };

  template <std::signed_integral T>
  PrintedValue(T v) : kind(Kind::kSigned), whole(v) {}  // NOLINT(google-explicit-constructor)
  template <std::unsigned_integral T>
  PrintedValue(T v)  // NOLINT(google-explicit-constructor)
      : kind(Kind::kUnsigned), whole(static_cast<long long>(v)) {}
  template <std::floating_point T>
  PrintedValue(T v)  // NOLINT(google-explicit-constructor)
      : kind(Kind::kReal), real(static_cast<double>(v)) {}
  PrintedValue(const char* v)
      : kind(Kind::kText), text(v) {}  // NOLINT(google-explicit-constructor)

  Kind kind;
  long long whole = 0;
  double real = 0.0;
  const char* text = "";
};

/// Appends what `printf` would print, but a number that rounds to zero never has a sign: `0.0`,
/// not `-0.0`. Conversions: d i u x (for integers of any size), f e g, s; flags, width and
/// precision as usual, `*` only as a precision. Padded text is cut at 399 characters. Allocates
/// nothing if the string has room.
void append_printed(std::string& out, const char* format, std::span<const PrintedValue> values);
template <class... Values>
void append_printed(std::string& out, const char* format, const Values&... values) {
  const std::array<PrintedValue, sizeof...(Values)> all = {PrintedValue(values)...};
  append_printed(out, format, std::span<const PrintedValue>(all));
}

/// The same, as a new string.
template <class... Values>
[[nodiscard]] std::string printed(const char* format, const Values&... values) {
  std::string out;
  append_printed(out, format, values...);
  return out;
}

/// Appends a value and its limit: `format` has a conversion f, e or g for each, in this order. If
/// the two would print alike, both get enough extra decimals to tell them apart, at most three; if
/// that is not enough, the text says "just over" or "just under" the limit.
void append_beside_limit(std::string& out, const char* format, double value, double limit);
[[nodiscard]] std::string beside_limit(const char* format, double value, double limit);

/// The value alone, if its limit is printed elsewhere: "2.04", "just over 2.0".
[[nodiscard]] std::string value_beside(double value, double limit, int decimals);

}  // namespace orthonav
