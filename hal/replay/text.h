#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/transform.h"

namespace orthonav::replay {

/// Error about a file, or about a line of it: `PATH: line 7: WHY`.
Error file_error(const std::filesystem::path& path, const std::string& why,
                 ErrorCode code = ErrorCode::kInvalid);
Error line_error(const std::filesystem::path& path, std::size_t line, const std::string& why);

[[nodiscard]] bool is_there(const std::filesystem::path& path);

/// Whole text of a file of at most `max_bytes`.
Result<std::string> read_text(const std::filesystem::path& path, std::uintmax_t max_bytes);

/// Whole content of a file that must hold `bytes` bytes.
Result<std::string> read_sized(const std::filesystem::path& path, std::size_t bytes);

/// Writes a whole file.
Status write_bytes(const std::filesystem::path& path, std::span<const char> bytes);

/// Calls `take(line number from 1, text)` for each line that is not empty, without its line end,
/// and stops at the first failure.
Status for_each_line(const std::string& text,
                     const std::function<Status(std::size_t, std::string_view)>& take);

/// The same for a file that was written line by line: a last line without an end that can't be
/// parsed was truncated, and is skipped.
Status for_each_whole_line(const std::string& text,
                           const std::function<Status(std::size_t, std::string_view)>& take);

/// Whether a file ends within a line; only its end is read.
[[nodiscard]] bool is_torn_file(const std::filesystem::path& path);
/// Appends a place where a recording was truncated to the earlier ones; does nothing for an empty
/// one.
void note_cut(const std::string& where, std::string& all);

/// Calls `take` for each line after the header line of a CSV file, which must be `header`.
Status for_each_row(const std::filesystem::path& path, std::uintmax_t max_bytes,
                    std::string_view header, const std::function<Status(std::string_view)>& take);

/// The same for a file that our recorder wrote line by line: a last line without an end was
/// truncated, and is skipped; so is a header.
Status for_each_grown_row(const std::filesystem::path& path, std::uintmax_t max_bytes,
                          std::string_view header,
                          const std::function<Status(std::string_view)>& take);

/// Shortest text that reads back to the same bits, in any locale.
void append_number(std::string& text, double value);
void append_number(std::string& text, std::int64_t value);

/// The whole of `text` as a number, blanks around it allowed; nothing otherwise.
std::optional<double> parse_double(std::string_view text);
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Splits at the commas.
void split(std::string_view line, std::vector<std::string_view>& fields);

/// 16 row-major numbers of a rigid motion: finite, last row 0 0 0 1.
Result<std::array<double, 16>> parse_matrix(const std::vector<std::string_view>& fields,
                                            std::size_t first_field);

/// A pose as stored in the files; its translation is at most `max_translation_m` long.
template <class A, class B>
Result<Transform<A, B>> parse_pose(const std::vector<std::string_view>& fields,
                                   std::size_t first_field, double max_translation_m) {
  const auto matrix = parse_matrix(fields, first_field);
  if (!matrix) {
    return matrix.error();
  }
  auto pose = Transform<A, B>::from_row_major(*matrix);
  if (!pose) {
    return pose;
  }
  const double length_m = pose->translation().norm();
  if (!(length_m <= max_translation_m)) {
    return Error{"translation is " + std::to_string(length_m) + " m long, limit " +
                 std::to_string(max_translation_m) + " m"};
  }
  return pose;
}

}  // namespace orthonav::replay
