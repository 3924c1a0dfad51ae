#include "engine/golden/golden_stage.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "base/angle.h"
#include "engine/golden/golden_vertebra.h"
#include "engine/holograms/shapes/render_values.h"
#include "render/float3.h"
#include "render/projection.h"

namespace orthonav::engine::golden {
namespace {

using render::Float3;

constexpr float kToolLength_m = 0.080f;
constexpr Float3 kLooked = {0, 0.045f, 0};
/// From the patient's left and above, at the distance given by `surgeon`.
constexpr Float3 kFrom = {0.19f, 0.325f, -0.20f};

/// Across the planned axis, towards the patient's left and head.
Float3 tool_side() { return render::unit_or(cross({0.3f, 0, -1}, planned_direction()), {}); }

Float3 eye_at(float distance_m) { return kLooked + distance_m * render::unit_or(kFrom, {}); }

/// The head's up when it is rolled about its line of sight.
Float3 up_of(float roll_deg) {
  const Float3 back = render::unit_or(kFrom, {});
  const Float3 right = render::unit_or(render::cross({0, 0.3f, 1}, back), {});
  const Float3 up = render::cross(back, right);
  const auto roll = static_cast<float>(roll_deg * kRadiansPerDegree);
  return std::cos(roll) * up + std::sin(roll) * right;
}

}  // namespace

Float3 planned_direction() { return render::unit_or(kEntry - kTarget, {}); }

Float3 planned_point() { return kEntry + kToolLength_m * planned_direction(); }

Float3 tool_point(double angle_deg) {
  const Float3 along = planned_direction();
  const auto angle_rad = static_cast<float>(angle_deg * kRadiansPerDegree);
  return kEntry + kToolLength_m * (std::cos(angle_rad) * along + std::sin(angle_rad) * tool_side());
}

nav::ScrewPlan plan_of(Side side) {
  const bool left = side == Side::kLeft;
  return {side,
          {to_vec3(left ? kEntry : kOtherEntry)},
          {to_vec3(left ? kTarget : kOtherTarget)},
          0.003};
}

nav::ScrewGuidance guided(double angle_deg, double beside_m, double depth_m) {
  const nav::ScrewPlan plan = plan_of(Side::kLeft);
  const Vec3 along = to_vec3(planned_direction());
  const Vec3 side = to_vec3(tool_side());
  const double angle_rad = angle_deg * kRadiansPerDegree;
  const Point<World> tip{plan.entry.v + beside_m * side - depth_m * along};
  return nav::guide({Mat3::identity(), {}}, plan, tip,
                    std::cos(angle_rad) * along + std::sin(angle_rad) * side);
}

nav::ScrewNumbers numbers_of(const nav::ScrewGuidance& tool, const NumberSds& sds, Side side) {
  std::array<double, 36> covariance{};
  for (std::size_t i = 0; i < 3; ++i) {
    covariance[7 * i] = sds.translation_m * sds.translation_m;
    covariance[7 * (i + 3)] = sds.rotation_rad * sds.rotation_rad;
  }
  const nav::PoseUncertainty uncertainty(tool.tip.v, covariance);
  const auto deviation =
      nav::anatomical_deviation(plan_of(side), {{tool.tip.v}, -tool.tool_outward}, &uncertainty);
  return nav::ScrewNumberWriter().write(deviation.value());
}

nav::ScrewSizes sizes_of(const nav::ScrewGuidance& tool, const NumberSds& sds) {
  return nav::ScrewSizeWriter().write({tool.angle_rad, sds.rotation_rad},
                                      {tool.tip_off_axis_m, sds.translation_m});
}

nav::ShownDepth shown_depth(double depth_m, double to_target_m, double sd_m) {
  return nav::DepthWriter().write({depth_m, sd_m}, to_target_m).value();
}

std::vector<Float3> stroke(Side side) {
  const float lateral = side == Side::kLeft ? 1.0f : -1.0f;
  std::vector<Float3> samples;
  for (int i = 0; i < 120; ++i) {
    const float t = static_cast<float>(i) / 119.0f;
    const float angle_rad = t * 3.0f * 2.0f * std::numbers::pi_v<float>;
    const float aside = 0.0115f - 0.0015f * t - 0.0028f * std::cos(angle_rad);
    samples.push_back(
        on_golden_vertebra(lateral * aside, 0.0035f - 0.015f * t + 0.004f * std::sin(angle_rad)));
  }
  return samples;
}

std::vector<render::View> close_view(Float3 target) {
  const Float3 eye = target + Float3{0.24f, 0.36f, -0.16f};
  return {render::look_at(eye, target, {0, 0.3f, 1}, 0.120f, 0.078f)};
}

std::vector<render::View> surgeon_views(float distance_m, float roll_deg) {
  return render::stereo_pair(
      render::look_at(eye_at(distance_m), kLooked, up_of(roll_deg), 0.394f, 0.2561f));
}

Viewer surgeon(float distance_m, float roll_deg) { return {eye_at(distance_m), up_of(roll_deg)}; }

GoldenScene start(std::string name, std::string what, std::vector<render::View> views) {
  GoldenScene golden;
  golden.name = std::move(name);
  golden.what = std::move(what);
  golden.views = std::move(views);
  return golden;
}

GoldenScene start_wide(std::string name, std::string what, std::vector<render::View> views) {
  GoldenScene golden = start(std::move(name), std::move(what), std::move(views));
  golden.width_px = 720;
  golden.height_px = 468;
  return golden;
}

}  // namespace orthonav::engine::golden
