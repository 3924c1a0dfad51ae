#include "engine/session/log/operation_json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/session/calibration_in_use.h"
#include "engine/session/log/operation_identity.h"

namespace orthonav::engine {

void put_bounded(LogJson& json, const char* key, double value) {
  if (std::isfinite(value)) {
    json[key] = value;
  }
}

namespace {

/// The figures that `best` alone has.
void put_best(LogJson& json, const nav::Registration& r) {
  put_bounded(json, "tre_95_m", r.tre_95_m);
  put_bounded(json, "tre_99_m", r.tre_99_m);
  json["common_m"] = {r.common.tip_m, r.common.cameras_m, r.common.map_m};
  json["noise_m"] = r.noise_m;
  json["standoff_m"] = r.standoff_m;
  json["inlier_fraction"] = r.inlier_fraction;
  json["effective_points"] = r.effective_points;
  put_bounded(json, "log_likelihood_ratio", r.log_likelihood_ratio);
  json["coverage_fraction"] = r.coverage_fraction;
  json["shaft_collision_fraction"] = r.shaft_collision_fraction;
  json["field_sd_m"] = r.field_sd_m;
  json["correlation_across_strokes"] = r.correlation_across_strokes;
  json["size"] = r.size;
  json["size_sd"] = r.size_sd;
  put_bounded(json, "mirror_log_likelihood", r.mirror_log_likelihood);
  json["levels_compared"] = r.levels_compared;
  LogJson heights = LogJson::array();
  for (const nav::EstimatedHeight& height : r.heights) {
    heights.insert(heights.end(), {height.at.v.x, height.at.v.y, height.at.v.z, height.height_m});
  }
  json["heights_m"] = std::move(heights);
}

}  // namespace

LogJson json_at(Timestamp time) { return {{"time_ns", time.time_since_epoch().count()}}; }

LogJson json_of(Vec3 v) { return {v.x, v.y, v.z}; }

LogJson json_of(const OperationIdentity& identity) {
  LogJson json = {{"case", identity.case_name},
                  {"levels", identity.levels},
                  {"models_hash", identity.models_hash},
                  {"plan_hash", identity.plan_hash},
                  {"tools_hash", identity.tools_hash},
                  {"method", identity.method},
                  {"patient_reference", identity.patient_reference},
                  {"room", identity.room},
                  {"begun", identity.begun},
                  {"orthonav", identity.orthonav},
                  {"device", identity.device},
                  {"seed", identity.seed},
                  {"epoch_100ns", identity.epoch_100ns}};
  if (identity.errors) {
    json["common_errors"] = json_of(*identity.errors);
  }
  return json;
}

LogJson json_of(const nav::Registration& r) {
  LogJson json = {{"accepted", r.accepted},
                  {"provisional", r.provisional},
                  {"world_from_vertebra_m", r.world_from_vertebra.row_major()},
                  {"rmse_m", r.rmse_m},
                  {"runner_up_m", r.runner_up.row_major()},
                  {"points", r.points},
                  {"iterations", r.iterations}};
  put_bounded(json, "runner_up_rmse_m", r.runner_up_rmse_m);
  put_bounded(json, "predicted_tre_m", r.predicted_tre_m);
  if (r.uncertainty) {
    json["uncertainty"] = {{"centre_m", json_of(r.uncertainty->centre_m())},
                           {"covariance", r.uncertainty->covariance()}};
  }
  put_best(json, r);
  return json;
}

LogJson json_of(const nav::ScrewPlan& screw) {
  return {{"side", name_of(screw.side)},
          {"entry_m", json_of(screw.entry.v)},
          {"target_m", json_of(screw.target.v)},
          {"radius_m", screw.radius_m},
          {"accepted_breach", screw.accepted_breach}};
}

LogJson json_of(const nav::ReferencePlace& place) {
  return {{"tool", place.tool}, {"world_from_reference_m", place.anchored_from_marker.row_major()}};
}

LogJson json_of(const CalibrationInUse& found) {
  LogJson json = {{"pairs_refused", found.pairs_refused}, {"tags", LogJson::array()}};
  for (const TagSizeInUse& size : found.tags) {
    json["tags"].push_back({{"tool", size.tool},
                            {"applied", size.applied},
                            {"measured", size.measured},
                            {"sd", size.sd}});
  }
  if (found.cameras) {
    const CamerasInUse& cameras = *found.cameras;
    json["cameras"] = {{"rotation_rad", cameras.rotation_rad},
                       {"rotation_applied", cameras.rotation_applied},
                       {"focal_fraction", cameras.focal_fraction},
                       {"focal_sd", cameras.focal_sd},
                       {"baseline_fraction", cameras.baseline_fraction},
                       {"baseline_sd", cameras.baseline_sd},
                       {"pairs", cameras.pairs}};
  }
  return json;
}

LogJson json_of(const ErrorsInUse& errors) {
  const auto one = [](const ErrorSd& error) -> LogJson {
    return {{"sd", error.sd}, {"source", name_of(error.source)}};
  };
  return {{"tip_m", one(errors.tip_m)},
          {"cameras_m", one(errors.cameras_m)},
          {"map_m", one(errors.map_m)},
          {"map_drift_m_per_sqrt_s", one(errors.map_drift_m_per_sqrt_s)}};
}

namespace {

template <class Child>
Transform<World, Child> pose(const JsonNode& node, const char* key) {
  const auto read = Transform<World, Child>::from_row_major(array_from<16>(node, key));
  if (!read) {
    node.refuse(key, read.error().message);
    return {};
  }
  return *read;
}

nav::CommonErrors common(const JsonNode& node) {
  const auto [tip_m, cameras_m, map_m] = array_from<3>(node, "common_m");
  return {tip_m, cameras_m, map_m};
}

void read_best(const JsonNode& node, nav::Registration& r) {
  r.tre_95_m = bounded(node, "tre_95_m");
  r.tre_99_m = bounded(node, "tre_99_m");
  r.common = common(node);
  r.noise_m = node.number("noise_m");
  r.standoff_m = node.number("standoff_m");
  r.inlier_fraction = node.number("inlier_fraction");
  r.effective_points = node.number("effective_points");
  r.log_likelihood_ratio = bounded(node, "log_likelihood_ratio");
  r.coverage_fraction = node.number("coverage_fraction");
  r.shaft_collision_fraction = node.number("shaft_collision_fraction");
  r.field_sd_m = node.number("field_sd_m");
  r.correlation_across_strokes = node.number("correlation_across_strokes");
  r.size = node.number("size");
  r.size_sd = node.number("size_sd");
  r.mirror_log_likelihood = bounded(node, "mirror_log_likelihood");
  r.levels_compared = count_from(node, "levels_compared");
  const std::vector<double> heights = node.number_list("heights_m", 4 * kMostSamples);
  if (heights.size() % 4 != 0) {
    node.refuse("heights_m", "must be a place and a height each");
    return;
  }
  for (std::size_t i = 0; i < heights.size(); i += 4) {
    r.heights.push_back({{{heights[i], heights[i + 1], heights[i + 2]}}, heights[i + 3]});
  }
}

}  // namespace

double bounded(const JsonNode& node, const char* key) {
  return node.has(key) ? node.number(key) : std::numeric_limits<double>::infinity();
}

std::size_t count_from(const JsonNode& node, const char* key) {
  return static_cast<std::size_t>(node.unsigned_integer(key));
}

OperationIdentity identity_from(const JsonNode& node) {
  OperationIdentity identity;
  identity.case_name = node.text("case");
  identity.levels = node.texts("levels");
  identity.models_hash = node.text("models_hash");
  identity.plan_hash = node.text("plan_hash");
  identity.tools_hash = node.text("tools_hash");
  identity.method = node.text("method");
  identity.patient_reference = node.flag_or("patient_reference", false);
  identity.room = node.text("room");
  identity.begun = node.text("begun");
  identity.orthonav = node.text("orthonav");
  identity.device = node.text("device");
  identity.seed = node.unsigned_integer("seed");
  if (node.has("common_errors")) {
    identity.errors = errors_from(node.child("common_errors"));
  }
  return identity;
}

nav::Registration registration_from(const JsonNode& node) {
  nav::Registration r;
  r.accepted = node.flag_or("accepted", false);
  r.provisional = node.flag_or("provisional", false);
  r.world_from_vertebra = pose<Vertebra>(node, "world_from_vertebra_m");
  r.rmse_m = node.number("rmse_m");
  r.runner_up = pose<Vertebra>(node, "runner_up_m");
  r.points = count_from(node, "points");
  r.iterations = node.integer("iterations");
  r.runner_up_rmse_m = bounded(node, "runner_up_rmse_m");
  r.predicted_tre_m = bounded(node, "predicted_tre_m");
  if (node.has("uncertainty")) {
    const JsonNode uncertainty = node.child("uncertainty");
    r.uncertainty = nav::PoseUncertainty(uncertainty.vec3("centre_m"),
                                         array_from<36>(uncertainty, "covariance"));
  }
  read_best(node, r);
  return r;
}

Side side_from(const JsonNode& node) {
  const std::string text = node.text("side");
  const Side side = text == name_of(Side::kRight) ? Side::kRight : Side::kLeft;
  if (text != name_of(side)) {
    node.refuse("side", "is \"" + text + "\", must be left or right");
  }
  return side;
}

nav::ScrewPlan screw_from(const JsonNode& node) {
  nav::ScrewPlan screw;
  screw.side = side_from(node);
  screw.entry = {node.vec3("entry_m")};
  screw.target = {node.vec3("target_m")};
  screw.radius_m = node.number("radius_m");
  screw.accepted_breach = node.text("accepted_breach");
  return screw;
}

nav::ReferencePlace place_from(const JsonNode& node) {
  return {count_from(node, "tool"), pose<Marker>(node, "world_from_reference_m")};
}

CalibrationInUse calibration_from(const JsonNode& node) {
  CalibrationInUse out;
  out.pairs_refused = static_cast<std::int64_t>(node.number("pairs_refused"));
  for (const JsonNode& size : node.list("tags")) {
    out.tags.push_back(
        {size.text("tool"), size.number("applied"), size.number("measured"), size.number("sd")});
  }
  if (node.has("cameras")) {
    const JsonNode cameras = node.child("cameras");
    out.cameras = CamerasInUse{cameras.number("rotation_rad"),
                               cameras.flag_or("rotation_applied", false),
                               cameras.number("focal_fraction"),
                               cameras.number("focal_sd"),
                               cameras.number("baseline_fraction"),
                               cameras.number("baseline_sd"),
                               static_cast<std::int64_t>(cameras.number("pairs"))};
  }
  return out;
}

ErrorsInUse errors_from(const JsonNode& node) {
  const auto one = [&node](const char* key) {
    const JsonNode error = node.child(key);
    return ErrorSd{error.number("sd"), named<ErrorSource>(error, "source", kErrorSources)};
  };
  return {one("tip_m"), one("cameras_m"), one("map_m"), one("map_drift_m_per_sqrt_s")};
}

}  // namespace orthonav::engine
