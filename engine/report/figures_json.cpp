#include "engine/report/figures_json.h"

#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/session/steps/replanning.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

/// A 3x3 matrix by rows, times `factor`.
Json scaled(const std::array<double, 9>& covariance, double factor) {
  Json out = Json::array();
  for (const double value : covariance) {
    out.push_back(value * factor);
  }
  return out;
}

}  // namespace

void put_executed(Json& screw_json, const std::optional<nav::ExecutedTrajectory>& executed,
                  const std::optional<nav::ScrewClearance>& at_depth) {
  if (executed) {
    const Vec3 entry = executed->axis.point.v;
    const Vec3 direction = executed->axis.direction;
    Json& out = screw_json["executed"];
    out = {{"pairs", executed->pairs},
           {"entry_mm", Json::array({entry.x * 1e3, entry.y * 1e3, entry.z * 1e3})},
           {"direction", Json::array({direction.x, direction.y, direction.z})},
           {"depth_mm", executed->depth_m * 1e3}};
    if (executed->point_covariance_m2 && executed->direction_covariance_rad2) {
      out["entry_covariance_mm2"] = scaled(*executed->point_covariance_m2, 1e6);
      out["direction_covariance_rad2"] = scaled(*executed->direction_covariance_rad2, 1.0);
    }
  } else {
    screw_json["not_measured"].push_back("executed");
  }
  if (!at_depth) {
    screw_json["not_measured"].push_back("clearance");
  } else if (!at_depth->spread) {
    screw_json["not_measured"].push_back("grade_probability");
  }
}

Json grades_json(const std::array<double, nav::kPedicleGrades>& probability) {
  Json out = Json::object();
  for (std::size_t g = 0; g < nav::kPedicleGrades; ++g) {
    out[nav::name_of(static_cast<nav::PedicleGrade>(g))] = probability[g];
  }
  return out;
}

void put_planned_in_surgery(Json& screw_json,
                            const std::optional<nav::ScrewDifference>& difference) {
  if (!difference) {
    return;
  }
  const nav::ScrewDifference& d = *difference;
  screw_json["planned_in_surgery"] = {{"entry_cranial_mm", d.entry_cranial_m * 1e3},
                                      {"entry_medial_mm", d.entry_medial_m * 1e3},
                                      {"entry_inward_mm", d.entry_inward_m * 1e3},
                                      {"aim_cranial_deg", degrees(d.aim_cranial_rad)},
                                      {"aim_medial_deg", degrees(d.aim_medial_rad)},
                                      {"diameter_from_mm", d.diameter_from_m * 1e3},
                                      {"diameter_to_mm", d.diameter_to_m * 1e3},
                                      {"length_from_mm", d.length_from_m * 1e3},
                                      {"length_to_mm", d.length_to_m * 1e3},
                                      {"text", text_of(d)}};
}

Json calibration_json(const CalibrationInUse& found) {
  constexpr double kPercent = 1e-2;
  Json tags = Json::array();
  for (const TagSizeInUse& size : found.tags) {
    tags.push_back({{"tool", size.tool},
                    {"applied_percent", size.applied / kPercent},
                    {"measured_percent", size.measured / kPercent},
                    {"sd_percent", size.sd / kPercent}});
  }
  Json out = Json::object();
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

Json errors_json(const ErrorsInUse& errors) {
  Json out = Json::object();
  const auto put = [&out](const char* name, const char* key, const ErrorSd& error) {
    out[name] = {{key, error.sd * 1e3}, {"source", name_of(error.source)}};
  };
  put("tip", "sd_mm", errors.tip_m);
  put("cameras", "sd_mm", errors.cameras_m);
  put("map", "sd_mm", errors.map_m);
  put("map_drift", "sd_mm_per_sqrt_s", errors.map_drift_m_per_sqrt_s);
  return out;
}

}  // namespace orthonav::engine
