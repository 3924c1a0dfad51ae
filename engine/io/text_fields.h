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
/// The same, where a field in double quotes may hold the separator, and "" one quote (RFC 4180).
[[nodiscard]] std::vector<std::string> split_quoted(std::string_view line, char separator);
/// The first of these characters that the line has, or else the last of them.
[[nodiscard]] char separator_in(std::string_view line, std::string_view candidates);
/// The lines of a text, with or without carriage returns.
[[nodiscard]] std::vector<std::string> lines_of(std::string_view text);
/// A finite number and nothing else, with a decimal point in any locale.
[[nodiscard]] std::optional<double> number_from(std::string_view text);
/// The same, where the number may have a decimal comma.
[[nodiscard]] std::optional<double> number_with_comma(std::string text);
[[nodiscard]] std::string lower_case(std::string text);
/// A text file's bytes as UTF-8 without a byte order mark: UTF-16 is told by its mark (Excel's
/// "Unicode text").
[[nodiscard]] std::string as_utf8(std::string bytes);

}  // namespace orthonav::engine
