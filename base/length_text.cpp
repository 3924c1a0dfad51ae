#include "base/length_text.h"

#include <array>
#include <cstdio>

namespace orthonav {

std::string in_mm(double length_m, int decimals) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f mm", decimals, length_m * 1e3);
  return text.data();
}

}  // namespace orthonav
