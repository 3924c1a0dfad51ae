#include "engine/io/ply_points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>

#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

enum class Encoding { kAscii, kLittle, kBig };

struct Property {
  std::string name;
  std::size_t bytes = 0;
  bool real = false;
};

struct Header {
  Encoding encoding = Encoding::kAscii;
  bool has_format = false;
  std::size_t count = 0;
  std::vector<Property> properties;
  std::size_t end = 0;  ///< where the data begin
};

const std::map<std::string, std::size_t>& sizes() {
  static const std::map<std::string, std::size_t> kSizes = {
      {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
      {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  return kSizes;
}

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words = split(line, ' ');
  std::erase(words, "");
  return words;
}

Status read_format(const std::vector<std::string>& words, Header& header) {
  const std::string format = words.size() > 1 ? words[1] : "";
  header.has_format = true;
  if (format == "ascii") {
    return {};
  }
  header.encoding = format == "binary_little_endian" ? Encoding::kLittle : Encoding::kBig;
  if (header.encoding == Encoding::kBig && format != "binary_big_endian") {
    return Error{"unknown format \"" + format + "\""};
  }
  return {};
}

/// Takes one line of the header; `in_vertex` tells whether properties belong to the vertices.
Status take(const std::vector<std::string>& words, bool& in_vertex, Header& header) {
  if (words[0] == "format") {
    return read_format(words, header);
  }
  if (words[0] == "element") {
    if (words.size() != 3) {
      return Error{"an element line is not \"element NAME COUNT\""};
    }
    if (words[1] != "vertex" && header.properties.empty()) {
      return Error{"element " + words[1] + " stands before the vertices"};
    }
    in_vertex = words[1] == "vertex";
    const auto count = number_from(words[2]);
    if (!count || *count < 0 || *count > 1e8 || *count != std::floor(*count)) {
      return Error{"element count " + words[2] + " must be 0 to 100000000"};
    }
    if (in_vertex) {
      header.count = static_cast<std::size_t>(*count);
    }
  } else if (words[0] == "property" && in_vertex) {
    const auto size = words.size() == 3 ? sizes().find(words[1]) : sizes().end();
    if (size == sizes().end()) {
      return Error{"a vertex property has an unknown type"};
    }
    header.properties.push_back(
        {words[2], size->second, words[1].starts_with("float") || words[1] == "double"});
  }
  return {};
}

Result<Header> read_header(const std::string& text) {
  if (!text.starts_with("ply")) {
    return Error{"does not start with \"ply\""};
  }
  Header header;
  bool in_vertex = false;
  std::size_t at = 0;
  for (;;) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string::npos) {
      return Error{"has no end_header"};
    }
    const std::vector<std::string> words = words_of(text.substr(at, end - at));
    at = end + 1;
    if (words.empty()) {
      continue;
    }
    if (words[0] == "end_header") {
      break;
    }
    if (Status status = take(words, in_vertex, header); !status) {
      return status.error();
    }
  }
  header.end = at;
  if (!header.has_format) {
    return Error{"has no format line"};
  }
  return header;
}

struct Column {
  std::size_t index = 0;   ///< among the properties
  std::size_t offset = 0;  ///< in bytes
  std::size_t bytes = 0;
};

Result<std::vector<Column>> coordinate_columns(const Header& header) {
  std::vector<Column> columns;
  for (const char* name : {"x", "y", "z"}) {
    Column column;
    while (column.index < header.properties.size() &&
           header.properties[column.index].name != name) {
      column.offset += header.properties[column.index++].bytes;
    }
    if (column.index == header.properties.size() || !header.properties[column.index].real) {
      return Error{std::string("vertices have no float or double ") + name};
    }
    column.bytes = header.properties[column.index].bytes;
    columns.push_back(column);
  }
  return columns;
}

double real_at(const char* at, std::size_t bytes, Encoding encoding) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    const std::size_t byte = encoding == Encoding::kBig ? i : bytes - 1 - i;
    bits = bits << 8u | static_cast<unsigned char>(at[byte]);
  }
  return bytes == 8 ? std::bit_cast<double>(bits)
                    : std::bit_cast<float>(static_cast<std::uint32_t>(bits));
}

Result<std::vector<Vec3>> binary_points(const std::string& text, const Header& header,
                                        const std::vector<Column>& columns) {
  std::size_t stride = 0;
  for (const Property& property : header.properties) {
    stride += property.bytes;
  }
  if ((text.size() - header.end) / stride < header.count) {
    return Error{"ends after " + std::to_string((text.size() - header.end) / stride) + " of " +
                 std::to_string(header.count) + " vertices"};
  }
  std::vector<Vec3> points(header.count);
  for (std::size_t i = 0; i < header.count; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const Column& column = columns[static_cast<std::size_t>(axis)];
      points[i][axis] = real_at(text.data() + header.end + i * stride + column.offset, column.bytes,
                                header.encoding);
    }
  }
  return points;
}

Result<std::vector<Vec3>> ascii_points(const std::string& text, const Header& header,
                                       const std::vector<Column>& columns) {
  std::vector<Vec3> points;
  std::size_t at = header.end;
  while (points.size() < header.count && at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::vector<std::string> words = words_of(text.substr(at, end - at));
    at = end + 1;
    if (words.empty()) {
      continue;
    }
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t index = columns[static_cast<std::size_t>(axis)].index;
      const auto value = index < words.size() ? number_from(words[index]) : std::nullopt;
      if (!value) {
        return Error{"vertex " + std::to_string(points.size()) + " holds no finite x, y, z"};
      }
      point[axis] = *value;
    }
    points.push_back(point);
  }
  if (points.size() < header.count) {
    return Error{"ends after " + std::to_string(points.size()) + " of " +
                 std::to_string(header.count) + " vertices"};
  }
  return points;
}

}  // namespace

Result<std::vector<Vec3>> ply_points(const std::string& text, const std::string& name) {
  const auto refused = [&](const Error& error) { return Error{name + ": PLY " + error.message}; };
  const Result<Header> header = read_header(text);
  if (!header) {
    return refused(header.error());
  }
  const Result<std::vector<Column>> columns = coordinate_columns(*header);
  if (!columns) {
    return refused(columns.error());
  }
  Result<std::vector<Vec3>> points = header->encoding == Encoding::kAscii
                                         ? ascii_points(text, *header, *columns)
                                         : binary_points(text, *header, *columns);
  if (!points) {
    return refused(points.error());
  }
  for (std::size_t i = 0; i < points->size(); ++i) {
    if (!(*points)[i].is_finite()) {
      return refused(Error{"vertex " + std::to_string(i) + " is not finite"});
    }
  }
  return points;
}

std::string ply_text(std::span<const std::array<float, 3>> points, const std::string& comment) {
  static_assert(std::endian::native == std::endian::little);
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment " + comment +
                     "\nelement vertex " + std::to_string(points.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  text.append(reinterpret_cast<const char*>(points.data()), points.size_bytes());
  return text;
}

}  // namespace orthonav::engine
