#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "base/result.h"

namespace orthonav {

/// A finding in words: `format` as for printf, for the value and its limit (two of `%f`, `%e` or
/// `%g`) or for the value alone. Value and limit never print alike if they differ (base/printed.h).
[[nodiscard]] std::string with_numbers(const char* format, double value, double limit);

/// The same as an Error.
[[nodiscard]] inline Error refused(const char* format, double value, double limit) {
  return Error{with_numbers(format, value, limit)};
}

struct NamedNumber {
  const char* name;
  double value;
};
/// Reports every option that is not finite or not above 0.
void must_be_positive(std::initializer_list<NamedNumber> options,
                      std::vector<std::string>& problems);
/// Reports every option that is not above 0 and at most 1.
void must_be_fractions(std::initializer_list<NamedNumber> options,
                       std::vector<std::string>& problems);

}  // namespace orthonav
