#include "engine/report/html_text.h"

#include <cmath>

#include "base/printed.h"

namespace orthonav::engine {

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
  if (!std::isfinite(value)) {
    return "\u2013";
  }
  std::string out = printed("%.*f", decimals, value);
  if (!out.empty() && out[0] == '-') {
    out = "\u2212" + out.substr(1);
  }
  return out;
}

std::string formatted(const char* format, double a, double b, double c, double d) {
  return printed(format, a, b, c, d);
}

}  // namespace orthonav::engine
