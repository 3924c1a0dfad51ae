#pragma once

#include <string>

namespace orthonav::engine {

/// Stands for a value that is absent or unknown.
inline constexpr const char* kNoValue = "\u2013";

/// Shown beside an expected error, or a bound, that does not include common errors of all strokes.
inline constexpr const char* kRegistrationOnlyHtml = " <small>registration only</small>";

/// Escapes any text for use inside an HTML element or an attribute in double quotes.
[[nodiscard]] std::string html_escaped(const std::string& text);
/// printf with up to four numbers.
[[nodiscard]] std::string formatted(const char* format, double a, double b = 0.0, double c = 0.0,
                                    double d = 0.0);
/// A number for people, with a true minus sign; a dash if it is not finite.
[[nodiscard]] std::string html_number(double value, int decimals);
/// The same beside its limit, with enough decimals to tell them apart.
[[nodiscard]] std::string html_number_beside(double value, double limit, int decimals);

}  // namespace orthonav::engine
