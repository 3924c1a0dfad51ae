#pragma once

#include <string>

namespace orthonav::engine {

/// Any text as the text of an HTML element or of an attribute in double quotes.
[[nodiscard]] std::string html_escaped(const std::string& text);
/// A number as a person reads it, with a true minus sign; a dash where it is not finite.
[[nodiscard]] std::string html_number(double value, int decimals);

}  // namespace orthonav::engine
