#include "base/findings.h"

#include <cmath>

#include "base/printed.h"

namespace orthonav {

std::string with_numbers(const char* format, double value, double limit) {
  return beside_limit(format, value, limit);
}

void must_be_positive(std::initializer_list<NamedNumber> options,
                      std::vector<std::string>& problems) {
  for (const auto& [name, value] : options) {
    if (!(value > 0.0) || !std::isfinite(value)) {
      problems.push_back(std::string(name) + " " + printed("%f", value) + ", must be above 0");
    }
  }
}

void must_be_fractions(std::initializer_list<NamedNumber> options,
                       std::vector<std::string>& problems) {
  for (const auto& [name, value] : options) {
    if (!(value > 0.0 && value <= 1.0)) {
      problems.push_back(std::string(name) + " " + printed("%f", value) +
                         ", must be above 0 and at most 1");
    }
  }
}

}  // namespace orthonav
