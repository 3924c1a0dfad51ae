#include "engine/session/journal_screw_reading.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/angle.h"
#include "base/units.h"

namespace orthonav::engine {
namespace {

std::optional<std::array<double, nav::kPedicleGrades>> grades_of(const JsonNode& line) {
  if (!line.has("grade_probability")) {
    return std::nullopt;
  }
  const JsonNode node = line.child("grade_probability");
  std::array<double, nav::kPedicleGrades> out{};
  for (std::size_t g = 0; g < nav::kPedicleGrades; ++g) {
    out[g] = node.number(nav::name_of(static_cast<nav::PedicleGrade>(g)));
  }
  return out;
}

std::optional<RecordedPose> pose_of(const JsonNode& line) {
  if (!line.has("angle_deg")) {
    return std::nullopt;
  }
  return RecordedPose{line.number("angle_deg") * kRadiansPerDegree,
                      line.number("tip_to_entry_mm") * kMetresPerMm,
                      line.number("tip_off_axis_mm") * kMetresPerMm,
                      line.number("depth_mm") * kMetresPerMm,
                      optional_number(line, "clearance_mm", kMetresPerMm),
                      optional_number(line, "clearance_95_mm", kMetresPerMm),
                      line.text_or("grade", ""),
                      grades_of(line)};
}

std::optional<std::array<double, 9>> covariance_of(const JsonNode& node, const char* key,
                                                   double unit) {
  if (!node.has(key)) {
    return std::nullopt;
  }
  const std::vector<double> values = node.numbers(key, 9);
  std::array<double, 9> out{};
  for (std::size_t i = 0; i < std::min(values.size(), out.size()); ++i) {
    out[i] = values[i] * unit;
  }
  return out;
}

std::optional<nav::ExecutedTrajectory> executed_of(const JsonNode& line) {
  if (!line.has("executed")) {
    return std::nullopt;
  }
  const JsonNode node = line.child("executed");
  nav::ExecutedTrajectory out;
  out.axis = {{node.vec3("entry_mm") * kMetresPerMm}, node.vec3("direction")};
  out.depth_m = node.number("depth_mm") * kMetresPerMm;
  out.pairs = static_cast<std::size_t>(std::max(0, node.integer("pairs")));
  out.point_covariance_m2 =
      covariance_of(node, "entry_covariance_mm2", kMetresPerMm * kMetresPerMm);
  out.direction_covariance_rad2 = covariance_of(node, "direction_covariance_rad2", 1.0);
  if (out.point_covariance_m2.has_value() != out.direction_covariance_rad2.has_value()) {
    node.refuse("direction_covariance_rad2", "must stand beside entry_covariance_mm2");
  }
  return out;
}

}  // namespace

std::optional<double> optional_number(const JsonNode& line, const char* key, double unit) {
  return line.has(key) ? std::optional(line.number(key) * unit) : std::nullopt;
}

Side side_of(const JsonNode& line) {
  const std::string side = line.text("side");
  if (side != "left" && side != "right") {
    line.refuse("side", "is \"" + side + "\", must be left or right");
  }
  return side == "right" ? Side::kRight : Side::kLeft;
}

RecordedWire wire_of(const JsonNode& line) {
  return {line.number("angle_deg") * kRadiansPerDegree,
          line.number("angle_sd_deg") * kRadiansPerDegree,
          line.number("entry_mm") * kMetresPerMm,
          line.number("entry_sd_mm") * kMetresPerMm,
          line.flag_or("within", false),
          line.flag_or("kept", false)};
}

RecordedScrew screw_of(const JsonNode& line, Timestamp time) {
  RecordedScrew screw;
  screw.side = side_of(line);
  screw.done = true;
  screw.time = time;
  screw.at_depth = pose_of(line);
  screw.executed = executed_of(line);
  if (line.has("not_measured")) {
    screw.not_measured = line.texts("not_measured");
  }
  screw.wire_asked = line.has("wire");
  return screw;
}

}  // namespace orthonav::engine
