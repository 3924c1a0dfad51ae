#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orthonav::engine {

/// The text without surrounding spaces, tabs and carriage returns.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// The fields of one line; spaces, tabs and a carriage return around a field are dropped.
[[nodiscard]] std::vector<std::string> split(std::string_view line, char separator);
/// The lines of a text, with or without carriage returns.
[[nodiscard]] std::vector<std::string> lines_of(std::string_view text);
/// A finite number and nothing else, with a decimal point in any locale.
[[nodiscard]] std::optional<double> number_from(std::string_view text);
[[nodiscard]] std::string lower_case(std::string text);

}  // namespace orthonav::engine
