#include "engine/io/slicer_markups.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "engine/io/json_document.h"
#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

/// The columns with which every version of the legacy format begins; a file that declares others is
/// refused.
constexpr std::array<std::string_view, 4> kFirstColumns = {"id", "x", "y", "z"};
constexpr std::size_t kFirstCoordinate = 1;
constexpr std::size_t kLabelColumn = 11;
/// After the declared columns version 5 writes whether a point was placed (2) or not (undefined,
/// preview, missing): vtkMRMLMarkupsFiducialStorageNode.
constexpr std::size_t kStatusColumn = 14;

std::vector<MarkupPoint> defined_points(const JsonNode& markup) {
  std::vector<MarkupPoint> points;
  for (const JsonNode& node : markup.list("controlPoints")) {
    if (node.text_or("positionStatus", "defined") != "defined") {
      continue;
    }
    points.push_back({node.text_or("label", ""), node.vec3("position")});
  }
  return points;
}

/// Reads axes and unit of one markup; both must be declared, and the same in the whole file.
void read_frame(const JsonNode& node, bool first, MarkupsFile& file) {
  const std::string system = node.text("coordinateSystem");
  const std::string unit = node.first_text("coordinateUnits");
  const auto axes = axes_from(system);
  const auto metres = metres_per_unit_from(unit);
  if (!axes) {
    node.refuse("coordinateSystem", "is \"" + system + "\", must be LPS or RAS");
  }
  if (!metres) {
    node.refuse("coordinateUnits", "is \"" + unit + "\", must be mm or m");
  }
  if (!axes || !metres) {
    return;
  }
  if (!first && (*axes != file.axes || *metres != file.metres_per_unit)) {
    node.refuse("has another coordinate system or unit than the markups before it");
  }
  file.axes = *axes;
  file.metres_per_unit = *metres;
}

bool known_columns(const std::string& value) {
  const std::vector<std::string> names = split(value, ',');
  return names.size() >= kFirstColumns.size() &&
         std::equal(kFirstColumns.begin(), kFirstColumns.end(), names.begin()) &&
         (names.size() <= kLabelColumn || names[kLabelColumn] == "label");
}

std::optional<Axes> fcsv_axes(const std::string& value) {
  if (value == "0") {
    return Axes::kRas;
  }
  if (value == "1") {
    return Axes::kLps;
  }
  return axes_from(value);
}

/// A comment may say how the points are written: `CoordinateSystem = ...` or `columns = ...`.
Status read_remark(const std::string& remark, const std::string& where, std::optional<Axes>& axes) {
  const std::vector<std::string> parts = split(remark, '=');
  if (parts.size() != 2) {
    return {};
  }
  if (parts[0] == "CoordinateSystem") {
    axes = fcsv_axes(parts[1]);
    if (!axes) {
      return Error{where + ": CoordinateSystem must be LPS, RAS, 0 or 1"};
    }
  }
  if (parts[0] == "columns" && !known_columns(parts[1])) {
    return Error{where + ": columns are \"" + parts[1] +
                 "\", must be id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,..."};
  }
  return {};
}

}  // namespace

Status check_no_scene(const std::string& path, const std::string& instead) {
  const std::string name = lower_case(path);
  return name.ends_with(".mrml") || name.ends_with(".mrb")
             ? Status{Error{path + ": is a scene of 3D Slicer: " + instead}}
             : Status{};
}

bool is_markups_name(const std::string& path) {
  const std::string name = lower_case(path);
  return name.ends_with(".mrk.json") || name.ends_with(".fcsv");
}

Result<MarkupsFile> load_markups(const std::string& path) {
  return markups_in(JsonDocument::read(path), path);
}

Result<MarkupsFile> markups_in(const Result<JsonDocument>& document, const std::string& name) {
  if (!document) {
    return document.error();
  }
  MarkupsFile file;
  for (const JsonNode& node : document->root().list("markups")) {
    read_frame(node, file.markups.empty(), file);
    file.markups.push_back({node.text("type"), node.text_or("name", ""),
                            node.text_or("description", ""), defined_points(node)});
  }
  if (Status status = document->status(); !status) {
    return status.error();
  }
  if (file.markups.empty()) {
    return Error{name + ": markups is empty"};
  }
  return file;
}

Result<MarkupsFile> load_fcsv(const std::string& path) {
  const Result<std::string> text = read_text(path);
  if (!text) {
    return text.error();
  }
  std::optional<Axes> axes;
  Markup markup;
  markup.type = "Fiducial";
  int line_number = 0;
  for (const std::string& line : lines_of(*text)) {
    ++line_number;
    const std::string where = path + ": line " + std::to_string(line_number);
    if (line.starts_with('#')) {
      if (Status read = read_remark(line.substr(1), where, axes); !read) {
        return read.error();
      }
    } else if (!line.empty()) {
      const std::vector<std::string> fields = split_quoted(line, ',');
      if (fields.size() > kStatusColumn && fields[kStatusColumn] != "2" &&
          fields[kStatusColumn] != "") {
        continue;
      }
      Vec3 position;
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t column = kFirstCoordinate + static_cast<std::size_t>(axis);
        const auto value =
            column < fields.size() ? number_from(fields[column]) : std::optional<double>();
        if (!value) {
          return Error{where + ": must hold id,x,y,z,... with finite coordinates"};
        }
        position[axis] = *value;
      }
      markup.points.push_back({fields.size() > kLabelColumn ? fields[kLabelColumn] : "", position});
    }
  }
  if (!axes) {
    return Error{path + ": has no \"# CoordinateSystem =\" line"};
  }
  if (markup.points.empty()) {
    return Error{path + ": holds no points"};
  }
  return MarkupsFile{*axes, 1e-3, {std::move(markup)}};
}

}  // namespace orthonav::engine
