#include "engine/case/points_file.h"

#include <array>

#include "engine/io/json_document.h"
#include "engine/io/ply_file.h"
#include "engine/io/slicer_markups.h"
#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

/// The columns of x, y, z and, if any, the region.
struct Columns {
  std::array<std::size_t, 3> coordinate = {0, 1, 2};
  std::optional<std::size_t> region;
};

Result<Columns> columns_from_header(const std::vector<std::string>& names) {
  std::array<std::optional<std::size_t>, 4> found;
  const std::array<std::string, 4> wanted = {"x", "y", "z", "region"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t w = 0; w < wanted.size(); ++w) {
      if (lower_case(names[i]) == wanted[w]) {
        if (found[w]) {
          return Error{"column " + wanted[w] + " stands twice in the header"};
        }
        found[w] = i;
      }
    }
  }
  for (std::size_t w = 0; w < 3; ++w) {
    if (!found[w]) {
      return Error{"the header has no column " + wanted[w]};
    }
  }
  return Columns{{*found[0], *found[1], *found[2]}, found[3]};
}

bool is_header(const std::vector<std::string>& fields) {
  for (const std::string& field : fields) {
    if (lower_case(field) == "x") {
      return true;
    }
  }
  return false;
}

Result<Vec3> point_from(const std::vector<std::string>& fields, const Columns& columns) {
  Vec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t column = columns.coordinate[static_cast<std::size_t>(axis)];
    if (column >= fields.size()) {
      return Error{"has " + std::to_string(fields.size()) + " fields, must hold x,y,z"};
    }
    const auto value = number_from(fields[column]);
    if (!value) {
      return Error{"field \"" + fields[column].substr(0, 40) + "\" is not a number"};
    }
    point[axis] = *value;
  }
  return point;
}

Result<PointsFile> csv_points(const std::string& text, const std::string& path) {
  PointsFile file;
  Columns columns;
  bool first = true;
  int line_number = 0;
  for (std::string line : lines_of(text)) {
    ++line_number;
    const std::string where = path + ": line " + std::to_string(line_number) + ": ";
    if (line_number == 1 && line.starts_with("\xEF\xBB\xBF")) {
      line.erase(0, 3);
    }
    if (line.empty() || line.starts_with('#')) {
      continue;
    }
    const std::vector<std::string> fields = split(line, ',');
    if (std::exchange(first, false)) {
      if (is_header(fields)) {
        const Result<Columns> named = columns_from_header(fields);
        if (!named) {
          return Error{where + named.error().message};
        }
        columns = *named;
        continue;
      }
      if (fields.size() > 3) {
        columns.region = 3;
      }
    }
    const Result<Vec3> point = point_from(fields, columns);
    if (!point) {
      return Error{where + point.error().message};
    }
    file.points.push_back(*point);
    if (columns.region) {
      file.regions.push_back(*columns.region < fields.size() ? fields[*columns.region] : "");
    }
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
    return csv_points(*text, path);
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
