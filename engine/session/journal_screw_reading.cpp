#include "engine/session/journal_screw_reading.h"

#include "base/angle.h"
#include "base/units.h"

namespace orthonav::engine {
namespace {

std::optional<RecordedPose> pose_of(const JsonNode& line) {
  if (!line.has("angle_deg")) {
    return std::nullopt;
  }
  return RecordedPose{line.number("angle_deg") * kRadiansPerDegree,
                      line.number("tip_to_entry_mm") * kMetresPerMm,
                      line.number("tip_off_axis_mm") * kMetresPerMm,
                      line.number("depth_mm") * kMetresPerMm,
                      optional_number(line, "clearance_mm", kMetresPerMm),
                      optional_number(line, "clearance_95_mm", kMetresPerMm)};
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
  screw.wire_asked = line.has("wire");
  return screw;
}

}  // namespace orthonav::engine
