#include "engine/session/status_text.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace orthonav::engine {

void append_mm(std::string& out, double length_m, int decimals) {
  if (!std::isfinite(length_m)) {
    out += "-- mm";
    return;
  }
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f mm", decimals, length_m * 1e3);
  out += text.data();
}

void append_count(std::string& out, std::size_t count) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%zu", count);
  out += text.data();
}

}  // namespace orthonav::engine
