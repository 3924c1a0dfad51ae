#include "engine/io/ply_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "engine/io/ply_header.h"
#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

using ply::Element;
using ply::Encoding;
using ply::Kind;
using ply::Property;
using ply::Type;

/// The numbers after the header, one after another.
class Values {
 public:
  Values(std::string_view data, Encoding encoding) : data_(data), encoding_(encoding) {}

  /// Nothing at the end of the file, or if there is no number.
  std::optional<double> next(Type type) {
    return encoding_ == Encoding::kAscii ? next_word() : next_bytes(type);
  }
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  std::optional<double> next_word() {
    constexpr std::string_view kSpaces = " \t\r\n";
    const std::size_t from = std::min(data_.find_first_not_of(kSpaces), data_.size());
    data_.remove_prefix(from);
    ended_ = data_.empty();
    const std::string_view word = data_.substr(0, data_.find_first_of(kSpaces));
    data_.remove_prefix(word.size());
    return number_from(word);
  }

  std::optional<double> next_bytes(Type type) {
    if (data_.size() < type.bytes) {
      ended_ = true;
      return std::nullopt;
    }
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.bytes; ++i) {
      const std::size_t byte = encoding_ == Encoding::kBig ? i : type.bytes - 1 - i;
      bits = bits << 8U | static_cast<unsigned char>(data_[byte]);
    }
    data_.remove_prefix(type.bytes);
    if (type.kind == Kind::kReal) {
      return type.bytes == 8 ? std::bit_cast<double>(bits)
                             : std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    }
    const auto value = static_cast<double>(bits);
    const double range = std::ldexp(1.0, static_cast<int>(8 * type.bytes));
    return type.kind == Kind::kSigned && value >= range / 2 ? value - range : value;
  }

  std::string_view data_;
  Encoding encoding_;
  bool ended_ = false;
};

/// A row of an element: its single values by property, and the list of the wanted property.
struct Row {
  std::vector<double> values;
  std::vector<double> list;
};

/// False at the end of the file, or if there is no number.
bool read_row(const Element& element, std::size_t wanted_list, Values& values, Row& row) {
  row.values.assign(element.properties.size(), 0.0);
  row.list.clear();
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const Property& property = element.properties[i];
    const auto first = values.next(property.count.value_or(property.type));
    if (!first) {
      return false;
    }
    row.values[i] = *first;
    for (double k = 0; property.count && k < *first; ++k) {
      const auto value = values.next(property.type);
      if (!value) {
        return false;
      }
      if (i == wanted_list) {
        row.list.push_back(*value);
      }
    }
  }
  return true;
}

/// The index of the property with this name; the number of properties if there is none.
std::size_t property_named(const Element& element, std::string_view name) {
  const auto found = std::find_if(element.properties.begin(), element.properties.end(),
                                  [&](const Property& p) { return p.name == name; });
  return static_cast<std::size_t>(found - element.properties.begin());
}

Error ends_early(const Element& element, std::size_t rows) {
  return Error{"ends after " + std::to_string(rows) + " of " + std::to_string(element.count) +
               (element.name == "vertex" ? " vertices" : " " + element.name + "s")};
}

Status read_vertices(const Element& element, Values& values, PlyFile& file) {
  std::array<std::size_t, 3> columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    columns[axis] = property_named(element, name);
    if (columns[axis] == element.properties.size() ||
        element.properties[columns[axis]].type.kind != Kind::kReal ||
        element.properties[columns[axis]].count) {
      return Error{"vertices have no float or double " + name};
    }
  }
  Row row;
  for (std::size_t i = 0; i < element.count; ++i) {
    if (!read_row(element, element.properties.size(), values, row)) {
      return values.ended()
                 ? ends_early(element, i)
                 : Error{"vertex " + std::to_string(i) + " has a value that is not a number"};
    }
    const Vec3 v{row.values[columns[0]], row.values[columns[1]], row.values[columns[2]]};
    if (!v.is_finite()) {
      return Error{"vertex " + std::to_string(i) + " is not finite"};
    }
    file.vertices.push_back(v);
  }
  return {};
}

Status read_faces(const Element& element, Values& values, PlyFile& file) {
  std::size_t corners = property_named(element, "vertex_indices");
  if (corners == element.properties.size()) {
    corners = property_named(element, "vertex_index");
  }
  Row row;
  for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
    if (!read_row(element, corners, values, row)) {
      return values.ended()
                 ? ends_early(element, i)
                 : Error{"face " + std::to_string(i) + " has a value that is not a number"};
    }
    for (const double corner : row.list) {
      if (!(corner >= 0.0 && corner < static_cast<double>(file.vertices.size()))) {
        return Error{"face " + std::to_string(i) + " names a vertex that is not there"};
      }
      file.corners.push_back(static_cast<std::uint32_t>(corner));
    }
    file.corner_counts.push_back(static_cast<std::uint32_t>(row.list.size()));
  }
  return {};
}

Status skip(const Element& element, Values& values) {
  Row row;
  for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
    if (!read_row(element, element.properties.size(), values, row)) {
      return ends_early(element, i);
    }
  }
  return {};
}

enum class Wanted { kVertices, kFaces };

Result<PlyFile> read(const std::string& text, const std::string& name, Wanted wanted) {
  const auto refused = [&](const Error& error) { return Error{name + ": PLY " + error.message}; };
  const Result<ply::Header> header = ply::read_header(text);
  if (!header) {
    return refused(header.error());
  }
  PlyFile file;
  Values values(std::string_view(text).substr(header->end), header->encoding);
  bool has_vertices = false;
  for (const Element& element : header->elements) {
    const bool vertices = element.name == "vertex";
    const Status done = vertices                 ? read_vertices(element, values, file)
                        : element.name == "face" ? read_faces(element, values, file)
                                                 : skip(element, values);
    if (!done) {
      return refused(done.error());
    }
    has_vertices = has_vertices || vertices;
    if (has_vertices && wanted == Wanted::kVertices) {
      break;
    }
  }
  if (!has_vertices) {
    return refused(Error{"has no vertices"});
  }
  return file;
}

}  // namespace

Result<PlyFile> read_ply(const std::string& text, const std::string& name) {
  return read(text, name, Wanted::kFaces);
}

Result<std::vector<Vec3>> ply_points(const std::string& text, const std::string& name) {
  auto file = read(text, name, Wanted::kVertices);
  if (!file) {
    return file.error();
  }
  return std::move(file->vertices);
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
