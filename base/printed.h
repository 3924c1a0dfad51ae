#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace orthonav {

/// One value to be printed, as its type was.
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
/// not `-0.0`. Conversions: d i u x (for any integer, whatever its length), f e g, s; flags, width
/// and precision as usual, `*` only as a precision. What is padded is cut at 399 characters.
/// Allocates nothing where the string has the room.
void append_printed(std::string& out, const char* format, std::span<const PrintedValue> values);
template <class... Values>
void append_printed(std::string& out, const char* format, const Values&... values) {
  const std::array<PrintedValue, sizeof...(Values)> all = {PrintedValue(values)...};
  append_printed(out, format, std::span<const PrintedValue>(all));
}

/// The same as a text of its own.
template <class... Values>
[[nodiscard]] std::string printed(const char* format, const Values&... values) {
  std::string out;
  append_printed(out, format, values...);
  return out;
}

/// Appends a value beside its limit: `format` has a conversion f, e or g for each, in this order.
/// Where the two would round alike, both get as many more decimals as it takes to tell them apart,
/// at most three; then it says "just over" or "just under" the limit.
void append_beside_limit(std::string& out, const char* format, double value, double limit);
[[nodiscard]] std::string beside_limit(const char* format, double value, double limit);

/// The value alone, for where its limit stands elsewhere: "2.04", "just over 2.0".
[[nodiscard]] std::string value_beside(double value, double limit, int decimals);

}  // namespace orthonav
