#include "engine/session/operation_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/io/bit_hash.h"

namespace orthonav::engine {
namespace {

/// Infinite values are left out, because JSON has no infinity.
void put_bounded(LogJson& json, const char* key, double value) {
  if (std::isfinite(value)) {
    json[key] = value;
  }
}

LogJson pose_json(const std::array<double, 16>& row_major) { return row_major; }

LogJson axis_json(const nav::Axis<Vertebra>& axis) {
  return {{"point_m", json_of(axis.point.v)}, {"direction", json_of(axis.direction)}};
}

LogJson number_json(const nav::NumberWithSd& number) { return {number.value, number.sd}; }

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
  return {{"case", identity.case_name},
          {"levels", identity.levels},
          {"models_hash", identity.models_hash},
          {"plan_hash", identity.plan_hash},
          {"tools_hash", identity.tools_hash},
          {"method", identity.method},
          {"patient_reference", identity.patient_reference},
          {"room", identity.room},
          {"begun", identity.begun},
          {"common_m", {identity.common.tip_m, identity.common.cameras_m, identity.common.map_m}}};
}

LogJson json_of(const nav::Region& region) {
  LogJson tips = LogJson::array();
  LogJson shafts = LogJson::array();
  LogJson sds = LogJson::array();
  for (const nav::Sample& sample : region.samples) {
    const Vec3 tip_m = sample.tip_in_world.v;
    tips.insert(tips.end(), {tip_m.x, tip_m.y, tip_m.z});
    const Vec3 shaft = sample.shaft_in_world;
    shafts.insert(shafts.end(), {shaft.x, shaft.y, shaft.z});
    sds.push_back(sample.tip_sd_m);
  }
  return {{"samples", region.samples.size()},
          {"tips_in_world_m", std::move(tips)},
          {"shafts_in_world", std::move(shafts)},
          {"tip_sds_m", std::move(sds)}};
}

LogJson json_of(const nav::Registration& r) {
  LogJson json = {{"accepted", r.accepted},
                  {"provisional", r.provisional},
                  {"world_from_vertebra_m", pose_json(r.world_from_vertebra.row_major())},
                  {"rmse_m", r.rmse_m},
                  {"runner_up_m", pose_json(r.runner_up.row_major())},
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

LogJson json_of(const nav::ExecutedTrajectory& executed) {
  LogJson json = axis_json(executed.axis);
  json["depth_m"] = executed.depth_m;
  json["pairs"] = executed.pairs;
  if (executed.point_covariance_m2) {
    json["point_covariance_m2"] = *executed.point_covariance_m2;
  }
  if (executed.direction_covariance_rad2) {
    json["direction_covariance_rad2"] = *executed.direction_covariance_rad2;
  }
  return json;
}

LogJson json_of(const nav::ScrewClearance& clearance) {
  const nav::Clearance& least = clearance.least;
  LogJson json = {{"clearance_m", least.clearance_m},
                  {"arc_length_m", least.arc_length_m},
                  {"outward", json_of(least.outward)},
                  {"on_tip", least.on_tip},
                  {"place_m", json_of(least.place.v)}};
  if (clearance.spread) {
    json["lower_95_m"] = clearance.spread->lower_95_m;
    json["grade_probability"] = clearance.spread->grade_probability;
  }
  return json;
}

LogJson json_of(const PlacedWire& wire) {
  LogJson json = axis_json(wire.axis.line);
  json["angle_rad"] = number_json(wire.axis.angle_rad);
  json["entry_m"] = number_json(wire.axis.entry_m);
  json["point_covariance_m2"] = wire.axis.point_covariance_m2;
  json["direction_covariance_rad2"] = wire.axis.direction_covariance_rad2;
  json["pairs"] = wire.pairs;
  json["angle_limit_rad"] = wire.angle_limit_rad;
  json["entry_limit_m"] = wire.entry_limit_m;
  json["kept"] = wire.kept;
  return json;
}

LogJson json_of(const Landmark& landmark) {
  return {{"in_vertebra_m", json_of(landmark.in_vertebra.v)},
          {"sd_m", landmark.sd_m},
          {"bone_sd_m", landmark.bone_sd_m}};
}

LogJson json_of(const nav::ReferencePlace& place) {
  return {{"tool", place.tool},
          {"world_from_reference_m", pose_json(place.anchored_from_marker.row_major())}};
}

std::string hash_of(std::span<const Point<World>> points) {
  BitHash hash;
  for (const Point<World>& point : points) {
    hash.add(point.v);
  }
  return hash.text();
}

}  // namespace orthonav::engine
