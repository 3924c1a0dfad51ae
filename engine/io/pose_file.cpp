#include "engine/io/pose_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "base/file_code.h"
#include "base/joined.h"
#include "base/printed.h"
#include "engine/io/json_document.h"
#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

using Pose = Transform<World, Marker>;

constexpr double kMetresPerMm = 1e-3;
// Files round rotations to three digits and more.
constexpr double kMostShear = 5e-3;
constexpr const char* kStatesTimes = ": states its times, so --rate-hz has no place there";
constexpr std::size_t kLongestPoseFile = std::size_t{256} << 20u;

std::string of_line(const std::string& path, std::size_t line) {
  return path + ", line " + std::to_string(line) + ": ";
}

/// "a, b" of the names, for messages.
std::string listed(const std::set<std::string>& names) {
  constexpr std::size_t kMost = 12;
  std::vector<std::string> some;
  for (const std::string& name : names) {
    if (some.size() == kMost) {
      some.emplace_back("...");
      break;
    }
    some.push_back(name);
  }
  return joined(some, ", ");
}

/// The unit of a format that states it; refuses another one.
Result<double> stated(double metres, const char* what, const std::string& path,
                      const PoseFileOptions& options) {
  if (options.metres_per_unit && *options.metres_per_unit != metres) {
    return Error{path + ": " + what + (metres == 1.0 ? " is in m" : " is in mm") +
                 ", but another unit is given (--units)"};
  }
  return metres;
}

/// Refuses what is out of any tracker's reach.
Result<Pose> within_reach(const Pose& pose, const std::string& where) {
  constexpr double kReachM = 1000.0;
  const double far_m = pose.translation().norm();
  if (!(far_m <= kReachM)) {
    return Error{where + printed("%g m away, limit %.0f m (another unit?)", far_m, kReachM)};
  }
  return pose;
}

Result<Pose> pose_from_rows(const std::array<double, 16>& rows, double metres_per_unit,
                            const std::string& where) {
  constexpr double kSameAsStated = 1e-6;
  if (std::abs(rows[12]) + std::abs(rows[13]) + std::abs(rows[14]) + std::abs(rows[15] - 1.0) >
      kSameAsStated) {
    return Error{where + "the last row of the matrix is not 0 0 0 1 (is it given by columns?)"};
  }
  std::array<double, 16> metric = rows;
  for (const std::size_t i : {3u, 7u, 11u}) {
    metric[i] *= metres_per_unit;
  }
  auto pose = Pose::from_row_major(metric, kMostShear);
  if (!pose) {
    return Error{where + pose.error().message};
  }
  return within_reach(*pose, where);
}

// Sequences of Plus and 3D Slicer: a text header with fields of each frame, then pictures.

struct SequenceFrames {
  std::map<std::string, std::map<int, std::array<double, 16>>> transforms;  ///< by name and frame
  std::set<std::pair<std::string, int>> not_ok;
  std::map<int, double> times_s;
};

Status add_matrix(const std::string& name, int frame, const std::string& text,
                  const std::string& where, SequenceFrames& out) {
  std::array<double, 16> rows{};
  std::size_t count = 0;
  for (const std::string& word : split(text, ' ')) {
    if (word.empty()) {
      continue;
    }
    const auto number = number_from(word);
    if (!number || count == rows.size()) {
      return Error{where + name + "Transform has '" + word + "', must be 16 numbers"};
    }
    rows[count++] = *number;
  }
  if (count != rows.size()) {
    return Error{where + name + "Transform has " + std::to_string(count) + " numbers, must be 16"};
  }
  out.transforms[name][frame] = rows;
  return {};
}

/// One line "Seq_Frame0012_StylusToTrackerTransform = ..."; others are passed over.
Status add_field(std::string_view line, const std::string& where, SequenceFrames& out) {
  constexpr std::string_view kFrame = "Seq_Frame";
  constexpr std::string_view kTransform = "Transform";
  constexpr std::string_view kState = "TransformStatus";
  const std::size_t equals = line.find('=');
  if (!line.starts_with(kFrame) || equals == std::string_view::npos) {
    return {};
  }
  std::string_view key = line.substr(kFrame.size(), equals - kFrame.size());
  key = trimmed(key.substr(0, key.find(':')));
  const std::string value(trimmed(line.substr(equals + 1)));
  const std::size_t end = key.find('_');
  const auto frame = number_from(key.substr(0, end));
  constexpr double kMaxFrames = 1e9;
  if (!frame || !(*frame >= 0.0 && *frame < kMaxFrames) || end == std::string_view::npos) {
    return Error{where + "a field of no frame"};
  }
  const auto index = static_cast<int>(*frame);
  const std::string name(key.substr(end + 1));
  if (name == "Timestamp") {
    const auto time_s = number_from(value);
    if (!time_s) {
      return Error{where + "Timestamp '" + value + "' is not a number"};
    }
    out.times_s[index] = *time_s;
  } else if (name.ends_with(kState)) {
    if (value != "OK") {
      out.not_ok.insert({name.substr(0, name.size() - kState.size()), index});
    }
  } else if (name.ends_with(kTransform)) {
    return add_matrix(name.substr(0, name.size() - kTransform.size()), index, value, where, out);
  }
  return {};
}

Result<SequenceFrames> sequence_frames(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  SequenceFrames out;
  std::size_t bytes = 0;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    bytes += line.size();
    if (bytes > kLongestPoseFile) {
      return Error{path + ": its header is longer than 256 MiB"};
    }
    if (line.starts_with("ElementDataFile") || trimmed(line).empty()) {
      break;  // pictures follow
    }
    if (const Status s = add_field(line, of_line(path, number), out); !s) {
      return s.error();
    }
  }
  return out;
}

/// The transforms whose product takes the tool to its frame: `through` after the inverse of `back`,
/// which is empty where the file has the transform itself.
struct Chosen {
  std::string name;
  std::string through;
  std::string back;
};

Result<Chosen> chosen_transform(const SequenceFrames& frames, const std::string& path,
                                const std::string& wanted) {
  std::set<std::string> names;
  for (const auto& [name, each] : frames.transforms) {
    names.insert(name);
  }
  if (names.empty()) {
    return Error{path + ": a sequence without transforms"};
  }
  if (wanted.empty() && names.size() == 1) {
    return Chosen{*names.begin(), *names.begin(), {}};
  }
  if (wanted.empty()) {
    return Error{path + ": has " + listed(names) +
                 ": name the tool's (--pose), such as StylusToTracker or StylusToReference"};
  }
  if (names.contains(wanted)) {
    return Chosen{wanted, wanted, {}};
  }
  const std::size_t to = wanted.find("To");
  for (const std::string& name : names) {
    if (to == std::string::npos || !name.starts_with(wanted.substr(0, to + 2))) {
      continue;
    }
    const std::string back = wanted.substr(to + 2) + "To" + name.substr(to + 2);
    if (names.contains(back)) {
      return Chosen{wanted, name, back};
    }
  }
  return Error{path + ": no transform is " + wanted + " (there are: " + listed(names) + ")"};
}

Result<PoseFile> sequence_poses(const std::string& path, const PoseFileOptions& options) {
  const auto metres = stated(kMetresPerMm, "a sequence", path, options);
  if (!metres) {
    return metres.error();
  }
  const auto frames = sequence_frames(path);
  if (!frames) {
    return frames.error();
  }
  const auto chosen = chosen_transform(*frames, path, options.pose);
  if (!chosen) {
    return chosen.error();
  }
  if (!frames->times_s.empty() && options.rate_hz) {
    return Error{path + kStatesTimes};
  }
  PoseFile out{"sequence", chosen->name, {}, {}, 0};
  for (const auto& [frame, rows] : frames->transforms.at(chosen->through)) {
    const bool relative = !chosen->back.empty();
    const std::array<double, 16>* back = nullptr;
    if (relative) {
      const auto& all = frames->transforms.at(chosen->back);
      const auto found = all.find(frame);
      back = found != all.end() ? &found->second : nullptr;
    }
    if (frames->not_ok.contains({chosen->through, frame}) ||
        (relative && (back == nullptr || frames->not_ok.contains({chosen->back, frame})))) {
      ++out.missing;
      continue;
    }
    const std::string where = path + ", frame " + std::to_string(frame) + ": ";
    auto pose = pose_from_rows(rows, *metres, where);
    if (pose && relative) {
      const auto reference = pose_from_rows(*back, *metres, where);
      if (!reference) {
        return reference.error();
      }
      const Transform<Marker, World> from_tracker = reference->inverse();
      const Mat3 rotation = from_tracker.rotation() * pose->rotation();
      pose = Pose(rotation,
                  from_tracker.rotation() * pose->translation() + from_tracker.translation());
    }
    if (!pose) {
      return pose.error();
    }
    out.world_from_marker.push_back(*pose);
    if (const auto time = frames->times_s.find(frame); time != frames->times_s.end()) {
      out.times_s.push_back(time->second);
    } else if (options.rate_hz) {
      out.times_s.push_back(frame / *options.rate_hz);
    }
  }
  if (out.times_s.size() != out.world_from_marker.size()) {
    out.times_s.clear();
  }
  return out;
}

// Tables of numbers.

/// Where in a row a pose stands; the whole row, or the part of one of several tools.
struct Layout {
  std::vector<std::size_t> position;
  std::vector<std::size_t> quaternion;  ///< x, y, z, w
  std::vector<std::size_t> matrix;      ///< 12, by rows
  std::optional<std::size_t> key;
  std::optional<std::size_t> status;
  std::optional<std::size_t> time;
  double seconds_per_tick = 1.0;
  double metres_per_unit = 0.0;
};

/// A comma stands between numbers, unless semicolons or tabs do: then it is a decimal comma.
char separator_of(std::string_view line) {
  const bool of_tabs =
      line.find('\t') != std::string_view::npos && line.find(",\t") == std::string_view::npos;
  return separator_in(line, of_tabs ? "; " : ";, ");
}

std::vector<std::string> fields_of(std::string line, char separator) {
  if (separator != ' ') {
    return split(line, separator);
  }
  std::replace(line.begin(), line.end(), '\t', ' ');
  std::vector<std::string> words = split(line, ' ');
  std::erase(words, "");
  return words;
}

/// The columns with these names within [from, to), a unit behind each left aside; empty unless all
/// are there.
std::vector<std::size_t> columns_named(const std::vector<std::string>& names,
                                       const std::vector<std::string>& wanted, std::size_t from,
                                       std::size_t to, std::set<std::string>& units) {
  std::vector<std::size_t> found;
  for (const std::string& name : wanted) {
    for (std::size_t i = from; i < to; ++i) {
      const bool with_unit = names[i] == name + "_mm" || names[i] == name + "_m";
      if (names[i] == name || with_unit) {
        if (with_unit) {
          units.insert(names[i].substr(name.size() + 1));
        }
        found.push_back(i);
        break;
      }
    }
  }
  return found.size() == wanted.size() ? found : std::vector<std::size_t>{};
}

std::vector<std::size_t> any_of_columns(const std::vector<std::string>& names,
                                        const std::vector<std::vector<std::string>>& choices,
                                        std::size_t from, std::size_t to,
                                        std::set<std::string>& units) {
  for (const auto& wanted : choices) {
    if (auto found = columns_named(names, wanted, from, to, units); !found.empty()) {
      return found;
    }
  }
  return {};
}

std::optional<std::size_t> column(const std::vector<std::string>& names,
                                  std::initializer_list<const char*> wanted, std::size_t from,
                                  std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    if (std::find(wanted.begin(), wanted.end(), names[i]) != wanted.end()) {
      return i;
    }
  }
  return std::nullopt;
}

bool is_ndi(const std::vector<std::string>& names) {
  return column(names, {"porthandle"}, 0, names.size()) &&
         column(names, {"transformstatus"}, 0, names.size()) &&
         column(names, {"q0"}, 0, names.size());
}

bool is_track(const std::vector<std::string>& names) {
  return names.size() > 9 && names[0] == "timestamp_100ns" && names[1] == "id" &&
         names[2] == "px" && names[9] == "origin";
}

void find_time(const std::vector<std::string>& names, Layout& out) {
  constexpr std::array<std::pair<const char*, double>, 3> kTimes = {
      {{"time_s", 1.0}, {"time_ms", 1e-3}, {"timestamp_100ns", 1e-7}}};
  for (const auto& [name, seconds] : kTimes) {
    if (const auto found = column(names, {name}, 0, names.size())) {
      out.time = found;
      out.seconds_per_tick = seconds;
      return;
    }
  }
}

/// The layout of the columns [from, to).
Result<Layout> layout_of(const std::vector<std::string>& names, std::size_t from, std::size_t to,
                         const std::string& path, const PoseFileOptions& options) {
  std::set<std::string> units;
  Layout out;
  out.position = any_of_columns(names, {{"px", "py", "pz"}, {"tx", "ty", "tz"}, {"x", "y", "z"}},
                                from, to, units);
  out.quaternion =
      any_of_columns(names, {{"qx", "qy", "qz", "qw"}, {"qx", "qy", "qz", "q0"}}, from, to, units);
  if (out.position.empty() || out.quaternion.empty()) {
    units.clear();
    std::vector<std::string> entries = {"m00", "m01", "m02", "m03", "m10", "m11",
                                        "m12", "m13", "m20", "m21", "m22", "m23"};
    const std::vector<std::string> three_rows = entries;
    entries.insert(entries.end(), {"m30", "m31", "m32", "m33"});
    out.matrix = any_of_columns(names, {entries, three_rows}, from, to, units);
  }
  if (out.matrix.empty() && (out.position.empty() || out.quaternion.empty())) {
    return Error{path +
                 ": its columns do not name a position (x y z, px py pz, tx ty tz) and a unit "
                 "quaternion (qx qy qz and qw or q0), nor a matrix (m00 to m23)"};
  }
  out.key = column(names, {"id", "porthandle"}, from, to);
  out.status = column(names, {"transformstatus", "status"}, from, to);
  find_time(names, out);
  if (out.time && options.rate_hz) {
    return Error{path + kStatesTimes};
  }
  if (units.size() > 1) {
    return Error{path + ": its columns are in mm and in m"};
  }
  const bool in_metres = is_track(names) || units.contains("m");
  if (in_metres || is_ndi(names) || !units.empty()) {
    const auto metres = stated(in_metres ? 1.0 : kMetresPerMm, "the position", path, options);
    if (!metres) {
      return metres.error();
    }
    out.metres_per_unit = *metres;
  } else if (options.metres_per_unit) {
    out.metres_per_unit = *options.metres_per_unit;
  } else {
    return Error{path + ": does not state its unit of length, give it (--units mm or --units m)"};
  }
  return out;
}

Result<std::array<double, 16>> numbers_at(const std::vector<std::string>& fields,
                                          const std::vector<std::size_t>& columns,
                                          const std::string& where) {
  std::array<double, 16> out{};
  out[15] = 1.0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] >= fields.size()) {
      return Error{where + "has " + std::to_string(fields.size()) + " columns, column " +
                   std::to_string(columns[i] + 1) + " is needed"};
    }
    const auto number = number_with_comma(fields[columns[i]]);
    if (!number) {
      return Error{where + "'" + fields[columns[i]] + "' in column " +
                   std::to_string(columns[i] + 1) + " is not a number"};
    }
    out[i] = *number;
  }
  return out;
}

Result<Pose> pose_in(const std::vector<std::string>& fields, const Layout& layout,
                     const std::string& where) {
  if (!layout.matrix.empty()) {
    const auto rows = numbers_at(fields, layout.matrix, where);
    return rows ? pose_from_rows(*rows, layout.metres_per_unit, where) : rows.error();
  }
  const auto at = numbers_at(fields, layout.position, where);
  if (!at) {
    return at.error();
  }
  const auto q = numbers_at(fields, layout.quaternion, where);
  if (!q) {
    return q.error();
  }
  const double norm =
      std::sqrt((*q)[0] * (*q)[0] + (*q)[1] * (*q)[1] + (*q)[2] * (*q)[2] + (*q)[3] * (*q)[3]);
  if (!(std::abs(norm - 1.0) <= kMostShear)) {
    return Error{where + printed("the quaternion's length is %.4f, must be 1", norm)};
  }
  const Vec3 t{(*at)[0], (*at)[1], (*at)[2]};
  const Mat3 rotation =
      rotation_from_quaternion({(*q)[0] / norm, (*q)[1] / norm, (*q)[2] / norm, (*q)[3] / norm});
  return within_reach(Pose(rotation, t * layout.metres_per_unit), where);
}

struct Table {
  std::vector<std::string> lines;
  std::vector<std::string> names;  ///< of the columns, in lower case
  std::size_t first = 0;           ///< line with numbers
  char separator = ',';
};

bool is_seen(const std::vector<std::string>& fields, const Layout& layout) {
  if (!layout.status) {
    return true;
  }
  const std::string state =
      *layout.status < fields.size() ? lower_case(fields[*layout.status]) : std::string();
  return state == "ok" || state == "enabled";
}

/// One part of a row: its pose, unless it is another tool's or was not seen.
Status add_part(const std::vector<std::string>& fields, const Layout& layout,
                const std::string& path, std::size_t line, const PoseFileOptions& options,
                std::set<std::string>& keys, PoseFile& out) {
  if (layout.key) {
    if (*layout.key >= fields.size()) {
      return {};  // a frame with fewer tools
    }
    const std::string& key = fields[*layout.key];
    keys.insert(key);
    if (!options.pose.empty() && key != options.pose) {
      return {};
    }
  }
  if (!is_seen(fields, layout)) {
    ++out.missing;
    return {};
  }
  const std::string where = of_line(path, line);
  const auto pose = pose_in(fields, layout, where);
  if (!pose) {
    return pose.error();
  }
  if (layout.time) {
    const auto time = numbers_at(fields, {*layout.time}, where);
    if (!time) {
      return time.error();
    }
    out.times_s.push_back((*time)[0] * layout.seconds_per_tick);
  } else if (options.rate_hz) {
    out.times_s.push_back(static_cast<double>(out.world_from_marker.size() + out.missing) /
                          *options.rate_hz);
  }
  out.world_from_marker.push_back(*pose);
  return {};
}

Result<PoseFile> table_poses(const Table& table, const std::string& path, PoseFileOptions options) {
  if (options.pose.empty() && options.tag >= 0 &&
      column(table.names, {"id"}, 0, table.names.size())) {
    options.pose = std::to_string(options.tag);
  }
  // NDI puts the tools of a frame side by side.
  std::vector<Layout> parts;
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    if (table.names[i] == "porthandle") {
      begins.push_back(i);
    }
  }
  if (begins.empty()) {
    begins.push_back(0);
  }
  for (std::size_t k = 0; k < begins.size(); ++k) {
    const std::size_t end = k + 1 < begins.size() ? begins[k + 1] : table.names.size();
    const auto layout = layout_of(table.names, begins[k], end, path, options);
    if (!layout) {
      return layout.error();
    }
    parts.push_back(*layout);
  }
  if (!parts.front().key && !options.pose.empty()) {
    return Error{path + ": has no ids, so none is '" + options.pose + "' (--pose)"};
  }
  PoseFile out;
  out.format = is_ndi(table.names) ? "NDI CSV" : (is_track(table.names) ? "track CSV" : "table");
  out.pose = options.pose;
  std::set<std::string> keys;
  for (std::size_t i = table.first; i < table.lines.size(); ++i) {
    if (trimmed(table.lines[i]).empty()) {
      continue;
    }
    const auto fields = fields_of(table.lines[i], table.separator);
    for (const Layout& part : parts) {
      if (const Status s = add_part(fields, part, path, i + 1, options, keys, out); !s) {
        return s.error();
      }
    }
  }
  if (options.pose.empty() && keys.size() > 1) {
    return Error{path + ": has poses of " + listed(keys) + ": name one (--pose)"};
  }
  if (!options.pose.empty() && !keys.contains(options.pose)) {
    return Error{path + ": no pose is of '" + options.pose + "' (there are: " + listed(keys) + ")"};
  }
  return out;
}

/// Four rows of four numbers a pose.
Result<PoseFile> block_poses(const std::vector<std::string>& lines, const std::string& path,
                             const PoseFileOptions& options) {
  if (!options.metres_per_unit) {
    return Error{path + ": does not state its unit of length, give it (--units mm or --units m)"};
  }
  PoseFile out;
  out.format = "matrices";
  std::array<double, 16> rows{};
  std::size_t filled = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto fields = fields_of(lines[i], separator_of(lines[i]));
    if (fields.empty()) {
      continue;
    }
    const std::string where = of_line(path, i + 1);
    const auto four = numbers_at(fields, {0, 1, 2, 3}, where);
    if (!four || fields.size() != 4) {
      return four ? Error{where + "must have four numbers, as the others"} : four.error();
    }
    std::copy_n(four->begin(), 4, rows.begin() + static_cast<std::ptrdiff_t>(filled));
    filled += 4;
    if (filled == rows.size()) {
      const auto pose = pose_from_rows(rows, *options.metres_per_unit, where);
      if (!pose) {
        return pose.error();
      }
      out.world_from_marker.push_back(*pose);
      if (options.rate_hz) {
        out.times_s.push_back(static_cast<double>(out.times_s.size()) / *options.rate_hz);
      }
      filled = 0;
    }
  }
  if (filled != 0) {
    return Error{path + ": ends within a matrix of four rows"};
  }
  return out;
}

Result<PoseFile> text_poses(const Result<std::string>& text, const std::string& path,
                            const PoseFileOptions& options) {
  if (!text) {
    return text.error();
  }
  Table table;
  table.lines = lines_of(as_utf8(*text));
  while (table.first < table.lines.size() && trimmed(table.lines[table.first]).empty()) {
    ++table.first;
  }
  if (table.first == table.lines.size()) {
    return Error{path + ": is empty"};
  }
  std::string heading = table.lines[table.first];
  table.separator = separator_of(heading);
  std::vector<std::string> fields = fields_of(heading, table.separator);
  const bool has_names = std::any_of(fields.begin(), fields.end(), [](const std::string& field) {
    return !field.empty() && !number_with_comma(field);
  });
  if (has_names && !options.columns.empty()) {
    return Error{path + ": its first line names the columns, so --columns has no place there"};
  }
  if (has_names) {
    if (fields.front().starts_with('#')) {
      fields.front().erase(0, 1);
    }
    ++table.first;
  } else if (!options.columns.empty()) {
    if (fields.size() != options.columns.size()) {
      return Error{path + ": has " + std::to_string(fields.size()) + " columns, but " +
                   std::to_string(options.columns.size()) + " are named (--columns)"};
    }
    fields = options.columns;
  } else if (fields.size() == 4) {
    return block_poses(table.lines, path, options);
  } else if (fields.size() == 16) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      fields[i] = "m" + std::to_string(i / 4) + std::to_string(i % 4);
    }
  } else {
    return Error{path + ": " + std::to_string(fields.size()) +
                 " columns without names, name them (--columns x,y,z,qx,qy,qz,qw)"};
  }
  for (const std::string& field : fields) {
    table.names.push_back(lower_case(std::string(trimmed(field))));
  }
  return table_poses(table, path, options);
}

/// What the first bytes show.
enum class PoseFileKind { kSequence, kText };

Result<PoseFileKind> kind_of(const std::string& path) {
  constexpr std::size_t kLooked = 4096;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    return Error{path + ": cannot be opened", code_of_unopened(path)};
  }
  std::string begin(kLooked, '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(in.gcount()));
  if (begin.starts_with("NRRD000") || begin.starts_with("ObjectType")) {
    return PoseFileKind::kSequence;
  }
  if (begin.starts_with("MATLAB")) {
    return Error{path + ": a MATLAB file is not read, save its poses as CSV"};
  }
  if (as_utf8(begin).find('\0') != std::string::npos) {
    return Error{path + ": is neither text nor a sequence of Plus or 3D Slicer"};
  }
  return PoseFileKind::kText;
}

}  // namespace

Result<PoseFile> load_poses(const std::string& path, const PoseFileOptions& options) {
  const auto kind = kind_of(path);
  if (!kind) {
    return kind.error();
  }
  if (*kind == PoseFileKind::kSequence && !options.columns.empty()) {
    return Error{path + ": is a sequence, so --columns has no place there"};
  }
  auto poses = *kind == PoseFileKind::kSequence
                   ? sequence_poses(path, options)
                   : text_poses(read_text(path, kLongestPoseFile), path, options);
  if (poses && poses->world_from_marker.empty()) {
    return Error{path + ": no pose in it was measured"};
  }
  constexpr double kLongestS = 1e6;
  if (poses && std::any_of(poses->times_s.begin(), poses->times_s.end(), [&](double time_s) {
        return !(std::abs(time_s - poses->times_s.front()) <= kLongestS);
      })) {
    return Error{path + ": its times are more than 1000000 s apart (another unit?)"};
  }
  return poses;
}

}  // namespace orthonav::engine
