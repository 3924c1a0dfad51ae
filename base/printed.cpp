#include "base/printed.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "base/beside_limit.h"
#include "base/translation.h"

namespace orthonav {
namespace {

using Buffer = std::array<char, 400>;
constexpr int kMaxMoreDecimals = 3;
constexpr int kUsualPrecision = 6;

/// One `%-8.2f` of a format.
struct Conversion {
  std::array<char, 24> flags{};  ///< with the width
  int precision = -1;            ///< -1: none
  bool star = false;             ///< the precision is a value of its own
  char letter = 0;
};

/// Reads the conversion that follows a `%` and advances the format past it.
Conversion take_conversion(const char*& format) {
  Conversion found;
  std::size_t count = 0;
  while (*format != 0 && std::strchr("-+ #0123456789", *format) != nullptr) {
    if (count + 1 < found.flags.size()) {
      found.flags[count++] = *format;
    }
    ++format;
  }
  if (*format == '.') {
    ++format;
    found.star = *format == '*';
    found.precision = 0;
    format += found.star ? 1 : 0;
    while (*format >= '0' && *format <= '9') {
      found.precision = 10 * found.precision + (*format++ - '0');
    }
  }
  while (*format != 0 && std::strchr("hlzjtL", *format) != nullptr) {
    ++format;  // the value knows its own length
  }
  found.letter = *format != 0 ? *format++ : 's';
  return found;
}

/// "-0.00", with any text before or after it.
bool is_negative_zero(const Buffer& text) {
  const char* const minus = std::strchr(text.data(), '-');
  const std::size_t zeros = minus == nullptr ? 0 : std::strspn(minus + 1, "0.");
  return zeros > 0 && std::strchr(" e", minus[1 + zeros]) != nullptr;
}

/// As snprintf prints it with the length modifier and the letter of its type.
template <class Value>
void print(Buffer& text, const Conversion& how, const char* type, Value value) {
  std::array<char, 40> format{};
  std::snprintf(format.data(), format.size(), "%%%s%s%s", how.flags.data(),
                how.precision < 0 ? "" : ".*", type);
  if (how.precision < 0) {
    std::snprintf(text.data(), text.size(), format.data(), value);
  } else {
    std::snprintf(text.data(), text.size(), format.data(), how.precision, value);
  }
}

void print_real(Buffer& text, const Conversion& how, double value) {
  const char type[] = {std::strchr("feg", how.letter) != nullptr ? how.letter : 'g', 0};
  print(text, how, type, value);
  if (is_negative_zero(text)) {
    print(text, how, type, 0.0);
  }
}

void append_value(std::string& out, const Conversion& how, const PrintedValue& value) {
  if (value.kind == PrintedValue::Kind::kText && how.flags[0] == 0 && how.precision < 0) {
    out += value.text;
    return;
  }
  Buffer text{};
  switch (value.kind) {
    case PrintedValue::Kind::kReal:
      print_real(text, how, value.real);
      break;
    case PrintedValue::Kind::kText:
      print(text, how, "s", value.text);
      break;
    case PrintedValue::Kind::kSigned:
      print(text, how, how.letter == 'x' ? "llx" : "lld", value.whole);
      break;
    case PrintedValue::Kind::kUnsigned:
      print(text, how, how.letter == 'x' ? "llx" : "llu", value.whole);
      break;
  }
  out += text.data();
}

/// Prints with `more` extra decimals in every real number and the words `before` ahead of the
/// first.
void append_with(std::string& out, const char* format, std::span<const PrintedValue> values,
                 int more, const char* before) {
  std::size_t next = 0;
  while (*format != 0) {
    const char* const percent = std::strchr(format, '%');
    if (percent == nullptr) {
      out += format;
      return;
    }
    out.append(format, static_cast<std::size_t>(percent - format));
    format = percent + 1;
    if (*format == '%') {
      out += *format++;
      continue;
    }
    Conversion how = take_conversion(format);
    if (how.star && next < values.size()) {
      how.precision = static_cast<int>(values[next++].whole);
    }
    if (next == values.size()) {
      continue;
    }
    const PrintedValue& value = values[next++];
    if (value.kind == PrintedValue::Kind::kReal && more > 0) {
      how.precision = (how.precision < 0 ? kUsualPrecision : how.precision) + more;
    }
    if (next == 1 && *before != 0) {
      out.append(before).append(" ");
    }
    append_value(out, how, value);
  }
}

/// The numbers that a reader sees for a value and its limit.
std::array<double, 2> as_read(const char* format, double value, double limit, int more) {
  std::array<double, 2> read = {value, limit};
  for (double& number : read) {
    const char* percent = std::strchr(format, '%');
    while (percent != nullptr && percent[1] == '%') {
      percent = std::strchr(percent + 2, '%');
    }
    if (percent == nullptr) {
      break;
    }
    format = percent + 1;
    Conversion how = take_conversion(format);
    how.precision = (how.precision < 0 ? kUsualPrecision : how.precision) + more;
    Buffer text{};
    print_real(text, how, number);
    number = std::strtod(text.data(), nullptr);
  }
  return read;
}

}  // namespace

void append_printed(std::string& out, const char* format, std::span<const PrintedValue> values) {
  append_with(out, format, values, 0, "");
}

void append_beside_limit(std::string& out, const char* format, double value, double limit) {
  const std::array<PrintedValue, 2> values = {value, limit};
  const bool differ = value != limit && std::isfinite(value) && std::isfinite(limit);
  for (int more = 0; differ && more <= kMaxMoreDecimals; ++more) {
    const auto read = as_read(format, value, limit, more);
    if (read[0] != read[1]) {
      return append_with(out, format, values, more, "");
    }
  }
  const char* const before =
      !differ ? "" : (value > limit ? translated(kJustOver) : translated(kJustUnder));
  append_with(out, format, values, 0, before);
}

std::string beside_limit(const char* format, double value, double limit) {
  std::string out;
  append_beside_limit(out, format, value, limit);
  return out;
}

std::string value_beside(double value, double limit, int decimals) {
  std::string both =
      beside_limit(printed("%%.%df;%%.%df", decimals, decimals).c_str(), value, limit);
  both.resize(both.find(';'));
  return both;
}

}  // namespace orthonav
