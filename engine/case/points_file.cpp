#include "engine/case/points_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/io/json_document.h"
#include "engine/io/ply_file.h"
#include "engine/io/slicer_markups.h"
#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

/// How a table is written.
struct Table {
  char separator = ',';
  std::array<std::size_t, 3> coordinate = {0, 1, 2};
  std::optional<std::size_t> region;
  std::optional<std::size_t> defined;  ///< of Slicer's table: 0 for a point that was not placed
  std::optional<Axes> axes;            ///< of Slicer's table
  std::size_t columns = 0;             ///< of the header; 0: there is none
};

/// The axes that the names of three columns state.
struct CoordinateNames {
  std::array<std::string, 3> names;
  std::optional<Axes> axes;
};

const std::array<CoordinateNames, 3>& coordinate_names() {
  static const std::array<CoordinateNames, 3> kNames = {
      {{{"x", "y", "z"}, {}}, {{"r", "a", "s"}, Axes::kRas}, {{"l", "p", "s"}, Axes::kLps}}};
  return kNames;
}

Result<std::optional<std::size_t>> column_of(const std::vector<std::string>& header,
                                             const std::string& name) {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) {
    return std::optional<std::size_t>();
  }
  if (std::find(found + 1, header.end(), name) != header.end()) {
    return Error{"column " + name + " stands twice in the header"};
  }
  return std::optional(static_cast<std::size_t>(found - header.begin()));
}

/// Whether the fields name columns, and not numbers.
bool is_header(const std::vector<std::string>& fields) {
  return std::any_of(fields.begin(), fields.end(), [](const std::string& field) {
    return field == "x" || field == "r" || field == "l";
  });
}

Status read_header(const std::vector<std::string>& header, Table& table) {
  for (const CoordinateNames& set : coordinate_names()) {
    if (std::find(header.begin(), header.end(), set.names[0]) == header.end()) {
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto column = column_of(header, set.names[i]);
      if (!column) {
        return column.error();
      }
      if (!*column) {
        return Error{"the header has no column " + set.names[i]};
      }
      table.coordinate[i] = **column;
    }
    table.axes = set.axes;
  }
  for (const auto& [name, place] :
       {std::pair{"region", &table.region}, {"defined", &table.defined}}) {
    const auto column = column_of(header, name);
    if (!column) {
      return column.error();
    }
    *place = *column;
  }
  table.columns = header.size();
  return {};
}

Result<Vec3> point_from(const std::vector<std::string>& fields, const Table& table) {
  const std::size_t most = table.columns != 0 ? table.columns : 4;
  const bool whole = std::none_of(fields.begin(), fields.end(), [](const std::string& field) {
    return field.find('.') != std::string::npos;
  });
  if (table.separator == ',' && whole && fields.size() > most) {
    return Error{"has " + std::to_string(fields.size()) +
                 " fields: are commas both decimal and between the fields? Separate them with ;"};
  }
  Vec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t column = table.coordinate[static_cast<std::size_t>(axis)];
    if (column >= fields.size()) {
      return Error{"has " + std::to_string(fields.size()) + " fields, must hold x,y,z"};
    }
    const auto value =
        table.separator == ',' ? number_from(fields[column]) : number_with_comma(fields[column]);
    if (!value) {
      return Error{"field \"" + fields[column].substr(0, 40) + "\" is not a number"};
    }
    point[axis] = *value;
  }
  return point;
}

std::vector<std::string> in_lower_case(std::vector<std::string> fields) {
  std::transform(fields.begin(), fields.end(), fields.begin(), lower_case);
  return fields;
}

Result<PointsFile> csv_points(const std::string& text, const std::string& path) {
  PointsFile file;
  Table table;
  bool first = true;
  int line_number = 0;
  for (const std::string& line : lines_of(text)) {
    ++line_number;
    const std::string where = path + ": line " + std::to_string(line_number) + ": ";
    if (line.empty() || line.starts_with('#')) {
      continue;
    }
    if (first) {
      table.separator = separator_in(line, ";\t,");
    }
    const std::vector<std::string> fields = split_quoted(line, table.separator);
    if (std::exchange(first, false)) {
      if (const auto names = in_lower_case(fields); is_header(names)) {
        if (const Status named = read_header(names, table); !named) {
          return Error{where + named.error().message};
        }
        continue;
      }
      if (fields.size() > 3) {
        table.region = 3;
      }
    }
    if (table.defined && *table.defined < fields.size() && fields[*table.defined] == "0") {
      continue;
    }
    const Result<Vec3> point = point_from(fields, table);
    if (!point) {
      return Error{where + point.error().message};
    }
    file.points.push_back(*point);
    if (table.region) {
      file.regions.push_back(*table.region < fields.size() ? fields[*table.region] : "");
    }
  }
  file.axes = table.axes;
  if (table.axes) {
    file.metres_per_unit = 1e-3;  // Slicer's
  }
  return file;
}

PointsFile points_of(const MarkupsFile& markups) {
  PointsFile file;
  file.metres_per_unit = markups.metres_per_unit;
  file.axes = markups.axes;
  for (const Markup& markup : markups.markups) {
    for (const MarkupPoint& point : markup.points) {
      file.points.push_back(point.position);
      file.regions.push_back(markup.name);
    }
  }
  return file;
}

Result<PointsFile> read_points(const std::string& path) {
  const std::string name = lower_case(path);
  if (Status s = check_no_scene(path, "save its points as .mrk.json"); !s) {
    return s.error();
  }
  if (is_markups_name(path)) {
    const Result<MarkupsFile> markups =
        name.ends_with(".fcsv") ? load_fcsv(path) : load_markups(path);
    if (!markups) {
      return markups.error();
    }
    return points_of(*markups);
  }
  const Result<std::string> text = read_text(path);
  if (!text) {
    return text.error();
  }
  if (!name.ends_with(".ply")) {
    return csv_points(as_utf8(*text), path);
  }
  Result<std::vector<Vec3>> points = ply_points(*text, path);
  if (!points) {
    return points.error();
  }
  PointsFile file;
  file.points = std::move(points).value();
  return file;
}

}  // namespace

Result<PointsFile> load_points(const std::string& path) {
  Result<PointsFile> file = read_points(path);
  if (file && file->points.empty()) {
    return Error{path + ": holds no points"};
  }
  return file;
}

}  // namespace orthonav::engine
