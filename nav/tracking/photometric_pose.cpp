#include "nav/tracking/photometric_pose.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

#include "nav/geometry/matrix_as.h"
#include "nav/tracking/photometric_light.h"
#include "nav/tracking/photometric_reduced.h"

namespace orthonav::nav {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int kFitMaxIterations = 10;
/// A smaller correction ends the search: a small part of the pose's noise.
constexpr double kFitLastStep_px = 0.02;
/// A view is not used if less of the tag than this agrees with its template.
constexpr double kMinKeptFraction = 0.45;
constexpr double kMinContrast_grey = 12.0;
constexpr double kLargestStepCells = 0.5;
constexpr double kNoiseFraction = 0.3;  ///< weight of the newest pair in the remembered noise
constexpr int kNewLightIterations = 5;
constexpr double kFewestPixels = 30.0;
/// The fraction of a step's length that remains for the steps after it.
constexpr double kLeftOfStep = 0.3;
/// Remaining doubt after convergence, due to noise.
constexpr double kSettledPx = 0.05;

/// The derivative of a small motion of the tag (in its frame, in cells) by a small motion of the
/// tool (in its own frame, in metres).
Matrix6 tag_by_tool(const Transform<Marker, Tag>& marker_from_tag, double cell_m) {
  Matrix6 out = Matrix6::Zero();
  const Mat3 tag_from_marker = marker_from_tag.rotation().transposed();
  const Vec3 lever_arm = marker_from_tag.translation();
  Eigen::Matrix3d r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      r(i, j) = tag_from_marker[i][static_cast<std::size_t>(j)];
    }
  }
  Eigen::Matrix3d cross;
  cross << 0, -lever_arm.z, lever_arm.y, lever_arm.z, 0, -lever_arm.x, -lever_arm.y, lever_arm.x, 0;
  out.topLeftCorner<3, 3>() = r / cell_m;
  out.topRightCorner<3, 3>() = -r * cross / cell_m;
  out.bottomRightCorner<3, 3>() = r;
  return out;
}

/// Least squares of the tool's motion over the views.
struct MotionEquations {
  Matrix6 normal = Matrix6::Zero();
  Vector6 right = Vector6::Zero();

  /// A view's equations, its light eliminated.
  void add(const TagView& view, const ViewEquations& of_view) {
    const Matrix6 motion = tag_by_tool(view.marker_from_tag, view.tag->cell_m());
    const ReducedView own = reduced(of_view, view.light);
    const Eigen::Map<const Matrix6> own_normal(own.normal.data());
    const Eigen::Map<const Vector6> own_right(own.right.data());
    normal += motion.transpose() * own_normal * motion;
    right += motion.transpose() * own_right;
  }
  /// False if the views do not determine the motion.
  bool solve(Eigen::Map<Vector6>& motion, PoseCovariance& covariance) const {
    const Eigen::LDLT<Matrix6> solver(normal);
    motion = solver.solve(right);
    if (solver.info() != Eigen::Success || !motion.allFinite() || !solver.isPositive()) {
      return false;
    }
    covariance = symmetrized(Matrix6(solver.solve(Matrix6::Identity())));
    return true;
  }
};

/// The pose after a motion in its own frame.
Transform<Rig, Marker> moved_in_itself(const Transform<Rig, Marker>& pose, Vec3 translation,
                                       Vec3 rotation_vector) {
  return {orthonormalized(pose.rotation() * rotation_from_vector(rotation_vector)),
          pose.translation() + pose.rotation() * translation};
}

/// The derivative of a tag's apparent motion (in its frame, in cells) by the errors of the
/// calibration, in the order of `CalibrationEquations`. `baseline_m`: from the right camera to the
/// left one; null for the left camera, which is taken as reported.
Matrix6 tag_by_calibration(const CameraFromTag& pose, const Vec3* baseline_m, double cell_m) {
  Matrix6 out = Matrix6::Zero();
  const Mat3 back = pose.rotation.transposed();
  const Vec3 place_m = pose.translation_m;
  const auto moves = [&](std::size_t unknown, Vec3 translation_m) {
    const Vec3 translation = back * translation_m / cell_m;
    out.col(static_cast<int>(unknown)).head<3>() << translation.x, translation.y, translation.z;
  };
  if (baseline_m != nullptr) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 unit_rotation{};
      unit_rotation[axis] = 1.0;
      moves(static_cast<std::size_t>(axis), unit_rotation.cross(place_m));
      const Vec3 rotation = back * unit_rotation;
      out.col(axis).tail<3>() << rotation.x, rotation.y, rotation.z;
    }
    // A magnified tag appears nearer along the optical axis by the same fraction.
    moves(kFocalUnknown, {0.0, 0.0, -place_m.z});
    moves(kBaselineUnknown, *baseline_m);
  }
  // A larger tag appears nearer by the same fraction.
  moves(kTagSizeUnknown, -place_m);
  return out;
}

}  // namespace

PhotometricSolver::PhotometricSolver(const StereoCalibration& calibration)
    : calibration_(calibration),
      left_rays_(std::make_shared<RayTable>(calibration_.left)),
      right_rays_(std::make_shared<RayTable>(calibration_.right)) {}

CameraFromTag PhotometricSolver::camera_from_tag(const TagView& view,
                                                 const Transform<Rig, Marker>& pose) const {
  const Transform<Rig, Tag> rig_from_tag = pose * view.marker_from_tag;
  if (view.right) {
    const auto seen = calibration_.right_from_rig * rig_from_tag;
    return {seen.rotation(), seen.translation()};
  }
  const auto seen = calibration_.left_from_rig * rig_from_tag;
  return {seen.rotation(), seen.translation()};
}

bool PhotometricSolver::gather(const StereoFrame& frame, const Transform<Rig, Marker>& pose,
                               double doubt_m, TagView& view, ViewEquations& e) {
  const BlurredTag& tag = *view.tag;
  model_.linearize(view.right ? frame.right : frame.left, camera_of(view),
                   view.right ? *right_rays_ : *left_rays_, tag, camera_from_tag(view, pose),
                   view.light, doubt_m / tag.cell_m(), view.cell_weights, e);
  e.sandwich_factor = sandwich_factor(e, view.light, model_.scores());
  view.kept_fraction = e.pixels > 0.0 ? e.kept / e.pixels : 0.0;
  return e.pixels >= kFewestPixels && view.kept_fraction >= kMinKeptFraction &&
         view.light.contrast >= kMinContrast_grey;
}

double PhotometricSolver::pixels_a_metre(const TagView& view,
                                         const Transform<Rig, Marker>& pose) const {
  return focal_px(view.right) / std::max(camera_from_tag(view, pose).translation_m.z, 1e-3);
}

/// Computes the light of each view, given the pose's step.
void PhotometricSolver::update_light(const std::array<double, 6>& step,
                                     const Transform<Rig, Marker>& pose,
                                     std::span<TagView> views) const {
  const Eigen::Map<const Vector6> motion(step.data());
  for (std::size_t i = 0; i < views.size(); ++i) {
    TagView& view = views[i];
    if (!view.used) {
      continue;
    }
    const double cell_m = view.tag->cell_m();
    std::array<double, 6> of_tag;
    Eigen::Map<Vector6>(of_tag.data()) = tag_by_tool(view.marker_from_tag, cell_m) * motion;
    const LightStep step_of_light = light_step(equations_[i], view.light, of_tag);
    apply(step_of_light, cell_m * pixels_a_metre(view, pose), view.light);
  }
}

/// The equations of the pose alone: those of every view, its light eliminated.
std::optional<PhotometricSolver::Step> PhotometricSolver::step(const StereoFrame& frame,
                                                               double doubt_m,
                                                               std::span<TagView> views,
                                                               PhotometricFit& fit) {
  MotionEquations equations;
  Step out;
  fit.views = 0;
  fit.left = fit.right = false;
  for (std::size_t i = 0; i < views.size(); ++i) {
    TagView& view = views[i];
    if (!view.used) {
      continue;
    }
    view.used = gather(frame, fit.rig_from_marker, doubt_m, view, equations_[i]);
    if (!view.used) {
      continue;
    }
    equations.add(view, equations_[i]);
    ++fit.views;
    (view.right ? fit.right : fit.left) = true;
    out.pixels_a_metre = std::max(out.pixels_a_metre, pixels_a_metre(view, fit.rig_from_marker));
    out.cell_m = std::min(out.cell_m, view.tag->cell_m());
  }
  Eigen::Map<Vector6> motion(out.motion.data());
  if (fit.views == 0 || !equations.solve(motion, fit.covariance)) {
    return std::nullopt;
  }
  update_light(out.motion, fit.rig_from_marker, views);
  // Displacement of the farthest cells, by translation and by rotation.
  out.size_m = std::max(motion.head<3>().norm(), motion.tail<3>().norm() * 4.0 * out.cell_m);
  const double limit_m = kLargestStepCells * out.cell_m;
  if (out.size_m > limit_m) {
    motion *= limit_m / out.size_m;
    out.size_m = limit_m;
  }
  return out;
}

std::optional<PhotometricFit> PhotometricSolver::solve(const StereoFrame& frame,
                                                       const Transform<Rig, Marker>& start,
                                                       double doubt_m, std::span<TagView> views) {
  PhotometricFit fit;
  fit.rig_from_marker = start;
  equations_.resize(views.size());
  double doubt = doubt_m;
  for (TagView& view : views) {
    view.cell_weights.clear();
  }
  while (fit.iterations < kFitMaxIterations) {
    const auto taken = step(frame, doubt, views, fit);
    if (!taken) {
      return std::nullopt;
    }
    const auto& m = taken->motion;
    fit.rig_from_marker =
        moved_in_itself(fit.rig_from_marker, {m[0], m[1], m[2]}, {m[3], m[4], m[5]});
    ++fit.iterations;
    doubt =
        std::max(std::min(kLeftOfStep * taken->size_m, doubt), kSettledPx / taken->pixels_a_metre);
    const bool all_known = learn_new_light(views);
    const int least = all_known ? 2 : kNewLightIterations;
    if (taken->size_m * taken->pixels_a_metre < kFitLastStep_px && fit.iterations >= least) {
      break;
    }
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!views[i].used) {
      continue;
    }
    if (views[i].light.known) {
      learn_noise(equations_[i], kNoiseFraction, views[i].light);
    }
    views[i].light.known = true;
  }
  return fit;
}

/// A new light is learnt during the fit: its initial error is not noise. True if none is new.
bool PhotometricSolver::learn_new_light(std::span<TagView> views) const {
  bool all_known = true;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!views[i].used || views[i].light.known) {
      continue;
    }
    all_known = false;
    learn_noise(equations_[i], 1.0, views[i].light);
  }
  return all_known;
}

std::optional<CalibrationEquations> PhotometricSolver::calibration_equations(
    const PhotometricFit& fit, std::span<const TagView> views) const {
  if (!fit.left || !fit.right || equations_.size() != views.size()) {
    return std::nullopt;
  }
  CalibrationEquations out;
  for (std::size_t l = 0; l < views.size(); ++l) {
    std::size_t r = 0;
    while (r < views.size() && !(views[r].right && views[r].used && views[r].tag == views[l].tag)) {
      ++r;
    }
    if (!views[l].right && views[l].used && r < views.size()) {
      add_tag(fit.rig_from_marker, views[l], view_equations(l, views[l]), views[r],
              view_equations(r, views[r]), out);
    }
  }
  return out.tags > 0 ? std::optional(out) : std::nullopt;
}

ReducedView PhotometricSolver::view_equations(std::size_t index, const TagView& view) const {
  return reduced(equations_.at(index), view.light);
}

ReducedView PhotometricSolver::shifted(const TagView& view, const ReducedView& at_best,
                                       const Transform<Rig, Marker>& best,
                                       const Transform<Rig, Marker>& pose) {
  const Transform<Marker, Marker> apart = pose.inverse() * best;
  const Vec3 turn = vector_from_rotation(apart.rotation());
  Vector6 motion;
  motion << apart.translation().x, apart.translation().y, apart.translation().z, turn.x, turn.y,
      turn.z;
  ReducedView out = at_best;
  Eigen::Map<Vector6>(out.right.data()) +=
      Eigen::Map<const Matrix6>(at_best.normal.data()) *
      (tag_by_tool(view.marker_from_tag, view.tag->cell_m()) * motion);
  return out;
}

/// The tag has its own pose: how it is mounted says nothing about the cameras.
void PhotometricSolver::add_tag(const Transform<Rig, Marker>& pose, const TagView& left,
                                const ReducedView& of_left, const TagView& right,
                                const ReducedView& of_right, CalibrationEquations& out) const {
  const Vec3 baseline_m =
      (calibration_.right_from_rig * calibration_.left_from_rig.inverse()).translation();
  Eigen::Map<Matrix6> information(out.information.data());
  Eigen::Map<Vector6> gradient(out.right.data());
  MotionEquations both;
  Matrix6 cross = Matrix6::Zero();
  double alone = 0.0;  // by which the error falls with a pose for each camera
  for (const bool is_right : {false, true}) {
    const TagView& view = is_right ? right : left;
    const ReducedView& own = is_right ? of_right : of_left;
    const Eigen::Map<const Matrix6> own_normal(own.normal.data());
    const Eigen::Map<const Vector6> own_right(own.right.data());
    const double cell_m = view.tag->cell_m();
    const Matrix6 motion = tag_by_tool(view.marker_from_tag, cell_m);
    const Matrix6 by_calibration =
        tag_by_calibration(camera_from_tag(view, pose), is_right ? &baseline_m : nullptr, cell_m);
    both.normal += motion.transpose() * own_normal * motion;
    both.right += motion.transpose() * own_right;
    cross += motion.transpose() * own_normal * by_calibration;
    information += by_calibration.transpose() * own_normal * by_calibration;
    gradient += by_calibration.transpose() * own_right;
    alone += own_right.dot(own_normal.ldlt().solve(own_right));
  }
  const Eigen::LDLT<Matrix6> solver(both.normal);
  const Vector6 step = solver.solve(both.right);
  information -= cross.transpose() * solver.solve(cross);
  gradient -= cross.transpose() * step;
  out.contradiction += alone - both.right.dot(step);
  ++out.tags;
}

}  // namespace orthonav::nav
