#include <algorithm>
#include <limits>

#include "engine/session/operation_json.h"

namespace orthonav::engine {
namespace {

constexpr std::size_t kMostSamples = 1'000'000;

double bounded(const JsonNode& node, const char* key) {
  return node.has(key) ? node.number(key) : std::numeric_limits<double>::infinity();
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
  identity.common = common(node);
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
    node.refuse("side", "must be left or right, is '" + text + "'");
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

}  // namespace orthonav::engine
