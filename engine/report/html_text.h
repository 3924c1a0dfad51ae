#pragma once

#include <string>

namespace orthonav::engine {

/// Beside an error to expect, or a bound, that lacks what all strokes share.
inline constexpr const char* kRegistrationOnlyHtml = " <small>registration only</small>";

/// Escapes any text for use inside an HTML element or an attribute in double quotes.
[[nodiscard]] std::string html_escaped(const std::string& text);
/// printf with up to four numbers.
[[nodiscard]] std::string formatted(const char* format, double a, double b = 0.0, double c = 0.0,
                                    double d = 0.0);
/// A number as a person reads it, with a true minus sign; a dash where it is not finite.
[[nodiscard]] std::string html_number(double value, int decimals);
/// The same beside its limit: with the decimals that tell one from the other.
[[nodiscard]] std::string html_number_beside(double value, double limit, int decimals);

}  // namespace orthonav::engine
