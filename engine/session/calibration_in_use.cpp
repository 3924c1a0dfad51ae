#include "engine/session/calibration_in_use.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "base/angle.h"
#include "engine/io/json_document.h"

namespace orthonav::engine {
namespace {

constexpr double kPercent = 1e-2;

}  // namespace

CalibrationInUse calibration_in_use(const nav::ToolTracker& tracker) {
  CalibrationInUse out;
  for (std::size_t i = 0; i < tracker.tools().size(); ++i) {
    if (const auto size = tracker.tag_size(i)) {
      out.tags.push_back({tracker.tools()[i].name, size->applied, size->fraction, size->sd});
    }
  }
  if (const auto found = tracker.alignment()) {
    out.cameras = CamerasInUse{
        found->rotation_rad.norm(), found->applied,     found->focal_fraction, found->focal_sd,
        found->baseline_fraction,   found->baseline_sd, found->pairs};
  }
  out.pairs_refused = tracker.picture_agreement().refused;
  return out;
}

JournalLine calibration_json(const CalibrationInUse& found) {
  JournalLine tags = JournalLine::array();
  for (const TagSizeInUse& size : found.tags) {
    tags.push_back({{"tool", size.tool},
                    {"applied_percent", size.applied / kPercent},
                    {"measured_percent", size.measured / kPercent},
                    {"sd_percent", size.sd / kPercent}});
  }
  JournalLine out = JournalLine::object();
  if (found.pairs_refused > 0) {
    out["pairs_refused"] = found.pairs_refused;
  }
  if (!found.tags.empty()) {
    out["tags"] = std::move(tags);
  } else {
    out["not_measured"].push_back("tags");
  }
  if (!found.cameras) {
    out["not_measured"].push_back("cameras");
    return out;
  }
  const CamerasInUse& cameras = *found.cameras;
  out["cameras"] = {{"rotation_deg", degrees(cameras.rotation_rad)},
                    {"rotation_applied", cameras.rotation_applied},
                    {"focal_percent", cameras.focal_fraction / kPercent},
                    {"focal_sd_percent", cameras.focal_sd / kPercent},
                    {"baseline_percent", cameras.baseline_fraction / kPercent},
                    {"baseline_sd_percent", cameras.baseline_sd / kPercent},
                    {"pairs", cameras.pairs}};
  return out;
}

CalibrationInUse calibration_of(const JsonNode& line) {
  CalibrationInUse out;
  if (line.has("pairs_refused")) {
    out.pairs_refused = static_cast<std::int64_t>(line.number("pairs_refused"));
  }
  if (line.has("tags")) {
    for (const JsonNode& size : line.list("tags")) {
      out.tags.push_back({size.text("tool"), size.number("applied_percent") * kPercent,
                          size.number("measured_percent") * kPercent,
                          size.number("sd_percent") * kPercent});
    }
  }
  if (line.has("cameras")) {
    const JsonNode cameras = line.child("cameras");
    out.cameras = CamerasInUse{cameras.number("rotation_deg") * kRadiansPerDegree,
                               cameras.flag_or("rotation_applied", false),
                               cameras.number("focal_percent") * kPercent,
                               cameras.number("focal_sd_percent") * kPercent,
                               cameras.number("baseline_percent") * kPercent,
                               cameras.number("baseline_sd_percent") * kPercent,
                               static_cast<std::int64_t>(cameras.number("pairs"))};
  }
  return out;
}

}  // namespace orthonav::engine
