#include "hal/replay/text.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <system_error>

#include "base/file_code.h"

namespace orthonav::replay {

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// A field, which may hold any bytes of any length, as shown in a message.
std::string quoted(std::string_view field) {
  std::string shown = "\"";
  for (const char c : field.substr(0, 24)) {
    shown += c >= 32 && c < 127 ? c : '?';
  }
  return shown + (field.size() > 24 ? "...\"" : "\"");
}

template <class T>
std::optional<T> parse(std::string_view text) {
  text = trimmed(text);
  T value{};
  const char* end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, value);
  if (text.empty() || code != std::errc{} || rest != end) {
    return std::nullopt;
  }
  return value;
}

template <class T>
void append(std::string& text, T value) {
  std::array<char, 32> digits;
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), result.ptr);
}

}  // namespace

Error file_error(const std::filesystem::path& path, const std::string& why, ErrorCode code) {
  return Error{path.string() + ": " + why, code};
}

Error line_error(const std::filesystem::path& path, std::size_t line, const std::string& why) {
  return file_error(path, "line " + std::to_string(line) + ": " + why);
}

bool is_there(const std::filesystem::path& path) {
  std::error_code code;
  return std::filesystem::exists(path, code);
}

Result<std::string> read_text(const std::filesystem::path& path, std::uintmax_t max_bytes) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) {
    return file_error(path, "no such file", ErrorCode::kNotFound);
  }
  if (!std::filesystem::is_regular_file(status)) {
    return file_error(path, "is not a file");
  }
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code) {
    return file_error(path, "cannot be read: " + code.message(), file_code(code));
  }
  if (size > max_bytes) {
    return file_error(
        path, "holds " + std::to_string(size) + " bytes, limit " + std::to_string(max_bytes));
  }
  std::ifstream file(path, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  file.read(text.data(), static_cast<std::streamsize>(size));
  if (!file || file.gcount() != static_cast<std::streamsize>(size)) {
    return file_error(path, "cannot be read", ErrorCode::kIo);
  }
  return text;
}

Result<std::string> read_sized(const std::filesystem::path& path, std::size_t bytes) {
  auto content = read_text(path, bytes);
  if (content && content->size() != bytes) {
    return file_error(path, "holds " + std::to_string(content->size()) + " bytes, must be " +
                                std::to_string(bytes));
  }
  return content;
}

Status write_bytes(const std::filesystem::path& path, std::span<const char> bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    return file_error(path, "cannot be written", ErrorCode::kIo);
  }
  return {};
}

Status for_each_line(const std::string& text,
                     const std::function<Status(std::size_t, std::string_view)>& take) {
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    ++number;
    std::string_view line(text.data() + begin, end - begin);
    if (!line.empty() && line.back() == '\r') {
      line.remove_suffix(1);
    }
    if (!trimmed(line).empty()) {
      if (Status status = take(number, line); !status) {
        return status;
      }
    }
    begin = end + 1;
  }
  return {};
}

bool is_torn_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(-1, std::ios::end);
  return file.good() && file.get() != '\n';
}

void note_cut(const std::string& where, std::string& all) {
  all += (all.empty() || where.empty() ? "" : "; ") + where;
}

Status for_each_whole_line(const std::string& text,
                           const std::function<Status(std::size_t, std::string_view)>& take) {
  return for_each_line(text, [&](std::size_t number, std::string_view line) -> Status {
    Status taken = take(number, line);
    const bool is_last = line.data() + line.size() == text.data() + text.size();
    return is_last ? Status{} : taken;
  });
}

namespace {

Status for_each_row_of(const std::string& text, const std::filesystem::path& path,
                       std::string_view header,
                       const std::function<Status(std::string_view)>& take) {
  bool seen_header = false;
  Status status = for_each_line(text, [&](std::size_t number, std::string_view line) -> Status {
    if (!seen_header) {
      seen_header = true;
      if (line == header) {
        return {};
      }
      return line_error(path, number, "must be \"" + std::string(header) + "\"");
    }
    if (Status taken = take(line); !taken) {
      return line_error(path, number, taken.error().message);
    }
    return {};
  });
  if (status && !seen_header) {
    return file_error(path, "is empty");
  }
  return status;
}

}  // namespace

Status for_each_row(const std::filesystem::path& path, std::uintmax_t max_bytes,
                    std::string_view header, const std::function<Status(std::string_view)>& take) {
  const auto text = read_text(path, max_bytes);
  return text ? for_each_row_of(*text, path, header, take) : text.error();
}

Status for_each_grown_row(const std::filesystem::path& path, std::uintmax_t max_bytes,
                          std::string_view header,
                          const std::function<Status(std::string_view)>& take) {
  auto text = read_text(path, max_bytes);
  if (!text) {
    return text.error();
  }
  text->resize(text->rfind('\n') + 1);  // npos + 1 is 0
  return text->empty() ? Status{} : for_each_row_of(*text, path, header, take);
}

void append_number(std::string& text, double value) { append(text, value); }
void append_number(std::string& text, std::int64_t value) { append(text, value); }

std::optional<double> parse_double(std::string_view text) { return parse<double>(text); }
std::optional<std::int64_t> parse_integer(std::string_view text) {
  return parse<std::int64_t>(text);
}

void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) {
      return;
    }
    line.remove_prefix(comma + 1);
  }
}

Result<std::array<double, 16>> parse_matrix(const std::vector<std::string_view>& fields,
                                            std::size_t first_field) {
  if (fields.size() < first_field + 16) {
    return Error{"matrix holds " +
                 std::to_string(fields.size() - std::min(first_field, fields.size())) +
                 " numbers, must be 16"};
  }
  std::array<double, 16> matrix{};
  for (std::size_t i = 0; i < 16; ++i) {
    const std::string_view field = fields[first_field + i];
    const auto value = parse_double(field);
    const std::string name = "m" + std::to_string(i / 4 + 1) + std::to_string(i % 4 + 1);
    if (!value) {
      return Error{name + " is " + quoted(field) + ", must be a number"};
    }
    if (!std::isfinite(*value)) {
      return Error{name + " is " + quoted(field) + ", must be finite"};
    }
    matrix[i] = *value;
  }
  constexpr double kLastRowTolerance = 1e-6;
  for (std::size_t c = 0; c < 4; ++c) {
    if (std::abs(matrix[12 + c] - (c == 3 ? 1.0 : 0.0)) > kLastRowTolerance) {
      return Error{"m4" + std::to_string(c + 1) + " is " + quoted(fields[first_field + 12 + c]) +
                   ", the last row must be 0,0,0,1 (row-major, column vectors)"};
    }
  }
  return matrix;
}

}  // namespace orthonav::replay
