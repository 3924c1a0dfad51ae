#include "engine/io/text_fields.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace orthonav::engine {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string> split(std::string_view line, char separator) {
  std::vector<std::string> fields;
  for (;;) {
    const std::size_t end = line.find(separator);
    fields.emplace_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) {
      return fields;
    }
    line.remove_prefix(end + 1);
  }
}

std::vector<std::string> split_quoted(std::string_view line, char separator) {
  std::vector<std::string> fields;
  for (;;) {
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos || line[first] != '"') {
      const std::size_t end = line.find(separator);
      fields.emplace_back(trimmed(line.substr(0, end)));
      if (end == std::string_view::npos) {
        return fields;
      }
      line.remove_prefix(end + 1);
      continue;
    }
    std::string field;
    std::size_t at = first + 1;
    for (; at < line.size() && (line[at] != '"' || line.substr(at, 2) == "\"\""); ++at) {
      field += line[at];
      at += line[at] == '"' ? 1 : 0;
    }
    fields.push_back(field);
    const std::size_t end = line.find(separator, at);
    if (end == std::string_view::npos) {
      return fields;
    }
    line.remove_prefix(end + 1);
  }
}

char separator_in(std::string_view line, std::string_view candidates) {
  const auto found = std::find_if(candidates.begin(), candidates.end(), [&](char candidate) {
    return line.find(candidate) != std::string_view::npos;
  });
  return found == candidates.end() ? candidates.back() : *found;
}

std::vector<std::string> lines_of(std::string_view text) { return split(text, '\n'); }

std::optional<double> number_from(std::string_view text) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
  }
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::optional<double> number_with_comma(std::string text) {
  if (std::count(text.begin(), text.end(), ',') == 1 && text.find('.') == std::string::npos) {
    std::replace(text.begin(), text.end(), ',', '.');
  }
  return number_from(text);
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string as_utf8(std::string bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) {
    return bytes.substr(3);
  }
  const bool little = bytes.starts_with("\xFF\xFE"), big = bytes.starts_with("\xFE\xFF");
  if (!little && !big) {
    return bytes;
  }
  const auto unit = [&](std::size_t at) {
    const auto low = static_cast<unsigned char>(bytes[at + (little ? 0 : 1)]);
    const auto high = static_cast<unsigned char>(bytes[at + (little ? 1 : 0)]);
    return static_cast<std::uint32_t>(low | high << 8);
  };
  std::string out;
  for (std::size_t at = 2; at + 1 < bytes.size(); at += 2) {
    std::uint32_t code = unit(at);
    if (code >= 0xD800 && code < 0xDC00 && at + 3 < bytes.size()) {  // the first of two
      at += 2;
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(at) - 0xDC00);
    }
    if (code < 0x80) {
      out += static_cast<char>(code);
      continue;
    }
    const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    const std::uint32_t mark = more == 1 ? 0xC0 : more == 2 ? 0xE0 : 0xF0;
    out += static_cast<char>(mark | (code >> 6 * more & 0x1F));
    for (int i = more - 1; i >= 0; --i) {
      out += static_cast<char>(0x80 | (code >> 6 * i & 0x3F));
    }
  }
  return out;
}

}  // namespace orthonav::engine
