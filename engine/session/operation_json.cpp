#include "engine/session/operation_json.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

LogJson json_of(const TipDifference& difference) {
  LogJson json = {{"apart_m", json_of(difference.apart_m)},
                  {"by_m", json_of(difference.by_m)},
                  {"corrected", difference.corrected}};
  put_bounded(json, "sd_m", difference.sd_m);
  put_bounded(json, "limit_m", difference.limit_m);
  return json;
}

LogJson json_of(const AxisDifference& difference) {
  return {{"off_rad", difference.off_rad},
          {"sd_rad", difference.sd_rad},
          {"by_rad", difference.by_rad},
          {"corrected", difference.corrected}};
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

LogJson json_of(const nav::ScrewGuidance& at_depth) {
  return {{"angle_rad", at_depth.angle_rad},
          {"tip_to_entry_m", at_depth.tip_to_entry_m},
          {"tip_off_axis_m", at_depth.tip_off_axis_m},
          {"depth_m", at_depth.depth_m}};
}

LogJson json_of(const RodState& rod) {
  LogJson json = {{"side", name_of(rod.side)}, {"heads", rod.heads.size()}};
  if (rod.rod) {
    json["length_m"] = rod.rod->length_m;
    json["bends"] = LogJson::array();
    for (const nav::RodBend& bend : rod.rod->bends) {
      json["bends"].push_back({{"arc_length_m", bend.arc_length_m}, {"angle_rad", bend.angle_rad}});
    }
  }
  if (rod.took_s) {
    json["took_s"] = *rod.took_s;
  }
  json["no_instructions"] = rod.no_instructions;
  if (rod.instructions) {
    json["cut_length_m"] = rod.instructions->cut_length_m();
    json["instructions"] = LogJson::array();
    for (const nav::RodInstruction& bend : rod.instructions->bends) {
      json["instructions"].push_back({{"centre_m", bend.arc.centre_m},
                                      {"roll_rad", bend.arc.roll_rad},
                                      {"angle_rad", bend.arc.angle_rad},
                                      {"set_rad", bend.set_rad}});
    }
  }
  if (rod.seat_by_pointer_m) {
    json["seat_by_pointer_m"] = *rod.seat_by_pointer_m;
  }
  if (rod.expected) {
    json["expected_within"] = rod.expected->within;
    json["least_sure"] = rod.expected->least_sure;
  }
  return json;
}

std::string hash_of(std::span<const Point<World>> points) {
  BitHash hash;
  for (const Point<World>& point : points) {
    hash.add(point.v);
  }
  return hash.text();
}

namespace {

constexpr std::size_t kMostSamples = 1'000'000;

double bounded(const JsonNode& node, const char* key) {
  return node.has(key) ? node.number(key) : std::numeric_limits<double>::infinity();
}

std::optional<double> number_if(const JsonNode& node, const char* key) {
  return node.has(key) ? std::optional(node.number(key)) : std::nullopt;
}

std::size_t count(const JsonNode& node, const char* key) {
  return static_cast<std::size_t>(node.unsigned_integer(key));
}

template <std::size_t n>
std::array<double, n> array(const JsonNode& node, const char* key) {
  std::array<double, n> values{};
  const std::vector<double> read = node.numbers(key, n);
  std::copy_n(read.begin(), std::min(n, read.size()), values.begin());
  return values;
}

template <std::size_t n>
std::optional<std::array<double, n>> array_if(const JsonNode& node, const char* key) {
  return node.has(key) ? std::optional(array<n>(node, key)) : std::nullopt;
}

template <class Child>
Transform<World, Child> pose(const JsonNode& node, const char* key) {
  const auto read = Transform<World, Child>::from_row_major(array<16>(node, key));
  if (!read) {
    node.refuse(key, read.error().message);
    return {};
  }
  return *read;
}

nav::Axis<Vertebra> axis(const JsonNode& node) {
  return {{node.vec3("point_m")}, node.vec3("direction")};
}

nav::NumberWithSd number(const JsonNode& node, const char* key) {
  const auto [value, sd] = array<2>(node, key);
  return {value, sd};
}

nav::CommonErrors common(const JsonNode& node) {
  const auto [tip_m, cameras_m, map_m] = array<3>(node, "common_m");
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
  r.levels_compared = count(node, "levels_compared");
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

nav::Region region_from(const JsonNode& node) {
  nav::Region region;
  region.saved = true;
  const std::size_t samples = count(node, "samples");
  if (samples > kMostSamples) {
    node.refuse("samples", "must be at most 1000000");
    return region;
  }
  const std::vector<double> tips_m = node.numbers("tips_in_world_m", 3 * samples);
  const std::vector<double> shafts = node.numbers("shafts_in_world", 3 * samples);
  const std::vector<double> sds_m = node.numbers("tip_sds_m", samples);
  if (tips_m.size() != 3 * samples || shafts.size() != 3 * samples || sds_m.size() != samples) {
    return region;
  }
  for (std::size_t i = 0; i < samples; ++i) {
    region.samples.push_back({{{tips_m[3 * i], tips_m[3 * i + 1], tips_m[3 * i + 2]}},
                              Timestamp{},
                              {shafts[3 * i], shafts[3 * i + 1], shafts[3 * i + 2]},
                              sds_m[i]});
  }
  return region;
}

nav::Registration registration_from(const JsonNode& node) {
  nav::Registration r;
  r.accepted = node.flag_or("accepted", false);
  r.provisional = node.flag_or("provisional", false);
  r.world_from_vertebra = pose<Vertebra>(node, "world_from_vertebra_m");
  r.rmse_m = node.number("rmse_m");
  r.runner_up = pose<Vertebra>(node, "runner_up_m");
  r.points = count(node, "points");
  r.iterations = node.integer("iterations");
  r.runner_up_rmse_m = bounded(node, "runner_up_rmse_m");
  r.predicted_tre_m = bounded(node, "predicted_tre_m");
  if (node.has("uncertainty")) {
    const JsonNode uncertainty = node.child("uncertainty");
    r.uncertainty =
        nav::PoseUncertainty(uncertainty.vec3("centre_m"), array<36>(uncertainty, "covariance"));
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

nav::ExecutedTrajectory executed_from(const JsonNode& node) {
  return {axis(node), node.number("depth_m"), count(node, "pairs"),
          array_if<9>(node, "point_covariance_m2"), array_if<9>(node, "direction_covariance_rad2")};
}

nav::ScrewClearance clearance_from(const JsonNode& node) {
  nav::ScrewClearance clearance;
  clearance.least = {node.number("clearance_m"),
                     node.number("arc_length_m"),
                     node.vec3("outward"),
                     node.flag_or("on_tip", false),
                     {node.vec3("place_m")}};
  if (node.has("lower_95_m")) {
    clearance.spread = nav::ClearanceSpread{node.number("lower_95_m"),
                                            array<nav::kPedicleGrades>(node, "grade_probability")};
  }
  return clearance;
}

PlacedWire wire_from(const JsonNode& node) {
  PlacedWire wire;
  wire.axis = {axis(node), number(node, "angle_rad"), number(node, "entry_m"),
               array<9>(node, "point_covariance_m2"), array<9>(node, "direction_covariance_rad2")};
  wire.pairs = count(node, "pairs");
  wire.angle_limit_rad = node.number("angle_limit_rad");
  wire.entry_limit_m = node.number("entry_limit_m");
  wire.kept = node.flag_or("kept", false);
  return wire;
}

nav::CheckPoint check_point_from(const JsonNode& node) {
  return {{node.vec3("in_world_m")},
          bounded(node, "distance_m"),
          node.flag_or("within", false),
          bounded(node, "limit_m")};
}

Landmark landmark_from(const JsonNode& node) {
  return {{node.vec3("in_vertebra_m")}, node.number("sd_m"), Timestamp{}, node.number("bone_sd_m")};
}

nav::ReferencePlace place_from(const JsonNode& node) {
  return {count(node, "tool"), pose<Marker>(node, "world_from_reference_m")};
}

TipDifference tips_from(const JsonNode& node) {
  return {node.vec3("apart_m"), bounded(node, "sd_m"), node.vec3("by_m"), bounded(node, "limit_m"),
          node.flag_or("corrected", false)};
}

AxisDifference axis_from(const JsonNode& node) {
  return {node.number("off_rad"), node.number("sd_rad"), node.number("by_rad"),
          node.flag_or("corrected", false)};
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

nav::ScrewGuidance at_depth_from(const JsonNode& node) {
  nav::ScrewGuidance out;
  out.angle_rad = node.number("angle_rad");
  out.tip_to_entry_m = node.number("tip_to_entry_m");
  out.tip_off_axis_m = node.number("tip_off_axis_m");
  out.depth_m = node.number("depth_m");
  return out;
}

void read_rod(const JsonNode& node, RodState& rod) {
  if (node.has("length_m")) {
    rod.rod.emplace().length_m = node.number("length_m");
    for (const JsonNode& bend : node.list("bends")) {
      rod.rod->bends.push_back({bend.number("arc_length_m"), bend.number("angle_rad"), {}});
    }
  }
  rod.took_s = number_if(node, "took_s");
  rod.no_instructions = node.text("no_instructions");
  if (node.has("cut_length_m")) {
    rod.instructions.emplace().fit.length_m = node.number("cut_length_m");
    for (const JsonNode& bend : node.list("instructions")) {
      nav::RodInstruction& read = rod.instructions->bends.emplace_back();
      read.arc.centre_m = bend.number("centre_m");
      read.arc.roll_rad = bend.number("roll_rad");
      read.arc.angle_rad = bend.number("angle_rad");
      read.set_rad = bend.number("set_rad");
    }
  }
  rod.seat_by_pointer_m = number_if(node, "seat_by_pointer_m");
  if (node.has("expected_within")) {
    rod.expected = nav::RodExpectation{node.number("expected_within"), count(node, "least_sure")};
  }
}

}  // namespace orthonav::engine
