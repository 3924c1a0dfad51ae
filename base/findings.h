#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "base/result.h"

namespace orthonav {

/// A finding in words: `format` as printf takes it, with the value and its limit (two `%f`, `%e` or
/// `%g`, or one), cut at 200 characters.
[[nodiscard]] std::string with_numbers(const char* format, double value, double limit);

/// The same as an Error.
[[nodiscard]] inline Error refused(const char* format, double value, double limit) {
  return Error{with_numbers(format, value, limit)};
}

struct NamedNumber {
  const char* name;
  double value;
};
/// Notes every one of the options that is not above 0, or not finite.
void must_be_positive(std::initializer_list<NamedNumber> options,
                      std::vector<std::string>& problems);

}  // namespace orthonav
