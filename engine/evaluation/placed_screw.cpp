#include "engine/evaluation/placed_screw.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <numeric>

#include "nav/guidance/placed_axis.h"

namespace orthonav::engine {
namespace {

constexpr double kFarthest_m = 0.015;
constexpr double kFarthest_rad = 0.5236;
constexpr double kSameDiameter_m = 0.0006;
constexpr double kShortest_m = 0.005;  ///< in the bone

bool has_planned_radius(const Shaft& shaft, const nav::ScrewPlan& plan) {
  return plan.radius_m > 0.0 && std::abs(2.0 * (shaft.radius_m - plan.radius_m)) < kSameDiameter_m;
}

/// Metal that looks too thick also reaches too far at the tip, by about half as much.
Vec3 tip_in_scan(const Shaft& shaft, const nav::ScrewPlan& plan) {
  const double too_large_m =
      has_planned_radius(shaft, plan) && shaft.tip_seen ? shaft.radius_m - plan.radius_m : 0.0;
  return shaft.line.at(shaft.to_s_m - 0.5 * too_large_m);
}

/// How far a cylinder lies from a plan.
struct OffPlan {
  double middle_m = 0.0;  ///< its axis, from the middle of the planned screw
  double angle_rad = 0.0;
};

OffPlan off_plan(const nav::ScrewCylinder& cylinder, const nav::ScrewPlan& plan) {
  const Vec3 planned = plan.target - plan.entry;
  const Vec3 to_middle = plan.entry.v + 0.5 * planned - cylinder.entry.v;
  return {to_middle.cross(cylinder.direction).norm(),
          angle_between_rad(planned, cylinder.direction)};
}

/// The uncertainty of the screw against the bone: that of the registration, plus that of the axis
/// in the scan as a motion about the registration's centre.
nav::PoseUncertainty total_uncertainty(const Shaft& shaft, const BoneRegistration& bone) {
  const Transform<Vertebra, Scan> vertebra_from_scan = bone.scan_from_vertebra.inverse();
  const Vec3 across = vertebra_from_scan.rotation() * shaft.line.across;
  const Vec3 athwart = vertebra_from_scan.rotation() * shaft.line.athwart;
  const Vec3 middle_m = (vertebra_from_scan * Point<Scan>{shaft.line.middle_m}).v;
  const Vec3 lever_arm_m = bone.uncertainty.centre_m() - middle_m;
  // A turn about the middle of the shaft is a turn about the centre plus a shift.
  const std::array<std::array<Vec3, 2>, 4> motions = {{{across, {}},
                                                       {athwart, {}},
                                                       {athwart.cross(lever_arm_m), athwart},
                                                       {(-across).cross(lever_arm_m), -across}}};
  Eigen::Matrix<double, 6, 4> motion;
  for (Eigen::Index c = 0; c < 4; ++c) {
    const auto& [translation, rotation] = motions[static_cast<std::size_t>(c)];
    motion.col(c) << translation.x, translation.y, translation.z, rotation.x, rotation.y,
        rotation.z;
  }
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> own(shaft.covariance.data());
  const Eigen::Matrix<double, 6, 6> axis = motion * own * motion.transpose();
  std::array<double, 36> sum = bone.uncertainty.covariance();
  for (Eigen::Index i = 0; i < 36; ++i) {
    sum[static_cast<std::size_t>(i)] += axis(i / 6, i % 6);
  }
  return {bone.uncertainty.centre_m(), sum};
}

/// For the clearance: adds the uncertainty of the tip along the axis, and of the radius where it
/// was measured, as a shift of the whole cylinder along each direction.
nav::PoseUncertainty with_surface(const nav::PoseUncertainty& axis, Vec3 direction,
                                  bool radius_as_planned) {
  constexpr double kTip_m = 4e-5;
  constexpr double kRadius_m = 1.2e-4;
  std::array<double, 36> sum = axis.covariance();
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      sum[6 * row + column] +=
          kTip_m * kTip_m * direction[static_cast<int>(row)] * direction[static_cast<int>(column)];
    }
    sum[7 * row] += radius_as_planned ? 0.0 : kRadius_m * kRadius_m;
  }
  return {axis.centre_m(), sum};
}

}  // namespace

std::optional<nav::ScrewCylinder> cylinder_in_bone(const Shaft& shaft, const nav::ScrewPlan& plan,
                                                   const BoneInScan& bone) {
  const Transform<Vertebra, Scan> vertebra_from_scan =
      bone.registration.scan_from_vertebra.inverse();
  const Point<Vertebra> tip = vertebra_from_scan * Point<Scan>{tip_in_scan(shaft, plan)};
  nav::ScrewPlan sized = plan;
  sized.radius_m = has_planned_radius(shaft, plan) ? plan.radius_m : shaft.radius_m;
  Point<Vertebra> behind = vertebra_from_scan * shaft.rear();
  std::optional<nav::ScrewCylinder> out;
  // A bent wire's chord depends on its entry, and the entry on the chord.
  for (int round = 0; round < 4; ++round) {
    const Vec3 direction = (tip - behind).normalized();
    out = nav::cylinder_along({tip, direction}, sized, bone.surface);
    if (!out) {
      return std::nullopt;
    }
    out->length_m = (tip - out->entry).dot(out->direction);
    const Point<Scan> entry = bone.registration.scan_from_vertebra * out->entry;
    behind = vertebra_from_scan * Point<Scan>{shaft.line.at(shaft.line.s_of(entry.v))};
  }
  const OffPlan off = off_plan(*out, plan);
  const bool near =
      off.middle_m <= kFarthest_m && off.angle_rad <= kFarthest_rad && out->length_m >= kShortest_m;
  return near ? out : std::nullopt;
}

double distance_from_plan_m(const nav::ScrewCylinder& cylinder, const nav::ScrewPlan& plan) {
  constexpr double kOfAngle_m = 0.0115;  // 0.2 mm a degree
  const OffPlan off = off_plan(cylinder, plan);
  return off.middle_m + kOfAngle_m * off.angle_rad;
}

ScrewInScan placed_screw(const Shaft& shaft, const nav::ScrewPlan& plan,
                         const nav::ScrewCylinder& cylinder, const BoneInScan& bone) {
  const nav::PoseUncertainty unsure = total_uncertainty(shaft, bone.registration);
  const nav::PlacedAxis axis =
      nav::placed_axis(plan, {cylinder.entry, cylinder.direction}, unsure, {});
  const Point<Vertebra> tip = cylinder.entry + cylinder.length_m * cylinder.direction;
  ScrewInScan out;
  out.cylinder = cylinder;
  out.angle_rad = axis.angle_rad.value;
  out.angle_sd_rad = axis.angle_rad.sd;
  out.entry_m = (cylinder.entry - plan.entry).norm();
  out.entry_axis_m = axis.entry_m.value;
  out.entry_axis_sd_m = axis.entry_m.sd;
  out.target_m = (tip - plan.target).norm();
  out.depth_m = cylinder.length_m - (plan.target - plan.entry).norm();
  out.measured_radius_m = shaft.radius_m;
  out.radius_as_planned = has_planned_radius(shaft, plan);
  out.touched = shaft.touched;
  out.tip_seen = shaft.tip_seen;
  const double part = 0.5 * cylinder.length_m / shaft.line.half_m;
  out.bow_m = part * part * std::hypot(shaft.line.bow_across_m, shaft.line.bow_athwart_m);
  const nav::PoseUncertainty of_surface =
      with_surface(unsure, cylinder.direction, out.radius_as_planned);
  // Against the model: how far that is from the bone is not the scan's to say.
  const nav::ModelError none{0.0};
  if (const auto found = nav::screw_clearance(bone.surface, cylinder, &of_surface, none)) {
    out.clearance = found->least;
    out.spread = found->spread;
  }
  if (!out.radius_as_planned && shaft.radius_m < plan.radius_m) {
    nav::ScrewCylinder thick = cylinder;
    thick.radius_m = plan.radius_m;
    out.as_planned_screw = nav::least_clearance(bone.surface, thick);
  }
  return out;
}

std::vector<nav::PedicleGrade> likely_grades(const ScrewInScan& screw) {
  constexpr double kFirm = 0.9;
  if (!screw.clearance) {
    return {};
  }
  std::vector<nav::PedicleGrade> out{nav::grade_of(screw.clearance->clearance_m)};
  if (!screw.spread) {
    return out;
  }
  const auto& chance = screw.spread->grade_probability;
  std::vector<std::size_t> order(chance.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return chance[a] > chance[b]; });
  double sum = 0.0;
  for (auto g = order.begin(); g != order.end() && sum < kFirm; ++g) {
    sum += chance[*g];
    const auto grade = static_cast<nav::PedicleGrade>(*g);
    if (grade != out.front()) {
      out.push_back(grade);
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace orthonav::engine
