#pragma once

#include <array>
#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace orthonav::tools {

// Checks of the command line. The library itself would accept hexadecimal digits, a minus sign
// before an unsigned number, infinities, and empty text as a number.

/// A whole number in decimal digits and nothing else, from `low` to `high`.
[[nodiscard]] CLI::Validator whole_number(
    std::int64_t low, std::int64_t high = std::numeric_limits<std::int64_t>::max());
/// A seed of a random generator: 0 to 2^64 - 1.
[[nodiscard]] CLI::Validator seed_number();
/// A finite number with a decimal point and nothing else, from `low` to `high`.
[[nodiscard]] CLI::Validator finite_number(double low, double high);
/// Any text but an empty one: an unset variable in a script must not mean a default.
[[nodiscard]] CLI::Validator some_text();

/// Turns the path of a case.json into that of its folder, and takes any other as it is.
[[nodiscard]] CLI::Validator folder_of_case();

// Options with the same meaning in every command.

/// `-c,--case`: a case folder, or the case.json in it.
CLI::Option* add_case_option(CLI::App& command, std::string& folder);
/// `-m,--method`: best or paper. `what` says what the method is for.
CLI::Option* add_method_option(CLI::App& command, std::string& method,
                               const std::string& what = "best, or paper: the published one");
/// `-l,--levels`: labels between commas; `what` says what they are for.
CLI::Option* add_levels_option(
    CLI::App& command, std::vector<std::string>& levels,
    const std::string& what = "levels to operate (default: the two lowest)");
/// `--rods-only`, which excludes `levels`.
void add_rods_only_flag(CLI::App& command, bool& rods_only, CLI::Option& levels);
/// That and `--seat-mm`, of every command that runs operations.
struct RodsOnlyArguments {
  bool rods_only = false;
  double seat_mm = 6.0;

  void add_to(CLI::App& command, CLI::Option& levels);
};
/// `-t,--tools` of commands that do not require it.
CLI::Option* add_tools_option(CLI::App& command, std::string& file);
/// `--reference`, of every command that runs operations.
void add_reference_flag(CLI::App& command, bool& reference);

/// `WIDTHxHEIGHT` in whole pixels and nothing else.
[[nodiscard]] std::optional<std::array<int, 2>> size_from(const std::string& text);

/// WIDTHxHEIGHT of a picture in pixels, both even, since videos need that.
[[nodiscard]] CLI::Validator picture_size();

}  // namespace orthonav::tools
