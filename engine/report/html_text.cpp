#include "engine/report/html_text.h"

#include <cmath>

#include "base/printed.h"

namespace orthonav::engine {
namespace {

std::string with_true_minus(const std::string& number) {
  return number.starts_with('-') ? "\u2212" + number.substr(1) : number;
}

}  // namespace

std::string html_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string html_number(double value, int decimals) {
  return std::isfinite(value) ? with_true_minus(printed("%.*f", decimals, value)) : kNoValue;
}

std::string html_number_beside(double value, double limit, int decimals) {
  return std::isfinite(value) ? with_true_minus(value_beside(value, limit, decimals)) : kNoValue;
}

std::string formatted(const char* format, double a, double b, double c, double d) {
  return printed(format, a, b, c, d);
}

}  // namespace orthonav::engine
