#include "base/findings.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace orthonav {

std::string with_numbers(const char* format, double value, double limit) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), format, value, limit);
  return text.data();
}

void must_be_positive(std::initializer_list<NamedNumber> options,
                      std::vector<std::string>& problems) {
  for (const auto& [name, value] : options) {
    if (!(value > 0.0) || !std::isfinite(value)) {
      problems.push_back(std::string(name) + " " + std::to_string(value) + ", must be above 0");
    }
  }
}

}  // namespace orthonav
