#include "nav/tracking/tag_pose.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <limits>
#include <vector>

#include "nav/geometry/absolute_orientation.h"
#include "nav/geometry/matrix_as.h"
#include "nav/geometry/rays.h"
#include "nav/statistics/levenberg_marquardt.h"

namespace orthonav::nav {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

constexpr double kDifferencePx = 0.05;

}  // namespace

std::array<Vec3, 4> corners_in_marker(double size_m) {
  const double s = size_m / 2.0;
  return {{{-s, -s, 0.0}, {s, -s, 0.0}, {s, s, 0.0}, {-s, s, 0.0}}};
}

TagGeometry::TagGeometry(const StereoCalibration& calibration)
    : calibration_(calibration),
      rig_from_left_(calibration.left_from_rig.inverse()),
      rig_from_right_(calibration.right_from_rig.inverse()) {}

std::optional<Vec3> TagGeometry::corner_in_rig(Vec2 left_px, Vec2 right_px) const {
  const std::optional<Vec2> left = calibration_.left.unproject(left_px);
  const std::optional<Vec2> right = calibration_.right.unproject(right_px);
  if (!left || !right) {
    return std::nullopt;
  }
  const auto meeting = closest_point(
      {rig_from_left_.translation(), rig_from_left_.rotation() * Vec3{left->x, left->y, 1.0}},
      {rig_from_right_.translation(), rig_from_right_.rotation() * Vec3{right->x, right->y, 1.0}});
  if (!meeting) {
    return std::nullopt;
  }
  return meeting->point_m;
}

std::optional<double> TagGeometry::gap_px2(Vec3 in_rig_m, Vec2 left_px, Vec2 right_px) const {
  const Point<Rig> point{in_rig_m};
  const auto left = calibration_.left.project((calibration_.left_from_rig * point).v);
  const auto right = calibration_.right.project((calibration_.right_from_rig * point).v);
  if (!left || !right) {
    return std::nullopt;
  }
  return (*left - left_px).dot(*left - left_px) + (*right - right_px).dot(*right - right_px);
}

std::optional<TagPose> TagGeometry::pose(const TagPair& corners, double size_m) const {
  std::array<Vec3, 4> in_rig_m;
  double gap = 0.0;
  for (std::size_t i = 0; i < in_rig_m.size(); ++i) {
    const auto point_m = corner_in_rig(corners.left_px[i], corners.right_px[i]);
    if (!point_m) {
      return std::nullopt;
    }
    const auto squared = gap_px2(*point_m, corners.left_px[i], corners.right_px[i]);
    if (!squared) {
      return std::nullopt;
    }
    in_rig_m[i] = *point_m;
    gap += *squared;
  }
  const std::array<Vec3, 4> in_marker_m = corners_in_marker(size_m);
  const Result<RigidFit> fit = absolute_orientation(in_marker_m, in_rig_m);
  if (!fit) {
    return std::nullopt;
  }
  double edges_m = 0.0;
  for (std::size_t i = 0; i < in_rig_m.size(); ++i) {
    edges_m += (in_rig_m[(i + 1) % 4] - in_rig_m[i]).norm();
  }
  TagPose pose;
  pose.rig_from_marker = {fit->rotation, fit->translation_m};
  pose.size_ratio = edges_m / (4.0 * size_m);
  pose.fit_rmse_m = fit->rmse_m;
  pose.gap_px = std::sqrt(gap / 8.0);
  return pose;
}

std::optional<double> TagGeometry::residual_px(const Transform<Rig, Marker>& rig_from_marker,
                                               const TagPair& corners, double size_m) const {
  const std::array<Vec3, 4> in_marker_m = corners_in_marker(size_m);
  double sum = 0.0;
  for (std::size_t i = 0; i < in_marker_m.size(); ++i) {
    const Point<Rig> in_rig = rig_from_marker * Point<Marker>{in_marker_m[i]};
    const auto squared = gap_px2(in_rig.v, corners.left_px[i], corners.right_px[i]);
    if (!squared) {
      return std::nullopt;
    }
    sum += *squared;
  }
  return std::sqrt(sum / 8.0);
}

std::optional<PoseCovariance> TagGeometry::covariance(const Transform<Rig, Marker>& rig_from_marker,
                                                      const TagPair& corners, double size_m,
                                                      double left_variance_px2,
                                                      double right_variance_px2) const {
  const std::array<Vec3, 4> in_marker_m = corners_in_marker(size_m);
  Matrix6 normal = Matrix6::Zero();
  Matrix6 spread = Matrix6::Zero();
  for (std::size_t i = 0; i < in_marker_m.size(); ++i) {
    Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
    const auto add = [&](Vec2 left_step, Vec2 right_step, double variance) {
      const auto ahead =
          corner_in_rig(corners.left_px[i] + left_step, corners.right_px[i] + right_step);
      const auto behind =
          corner_in_rig(corners.left_px[i] - left_step, corners.right_px[i] - right_step);
      if (!ahead || !behind) {
        return false;
      }
      const Eigen::Vector3d slope =
          vector_as<Eigen::Vector3d>(*ahead - *behind) / (2.0 * kDifferencePx);
      noise += variance * slope * slope.transpose();
      return true;
    };
    if (!add({kDifferencePx, 0}, {}, left_variance_px2) ||
        !add({0, kDifferencePx}, {}, left_variance_px2) ||
        !add({}, {kDifferencePx, 0}, right_variance_px2) ||
        !add({}, {0, kDifferencePx}, right_variance_px2)) {
      return std::nullopt;
    }
    const Matrix36 j = moves_as<Matrix36>(rig_from_marker.rotation() * in_marker_m[i]);
    normal += j.transpose() * j;
    spread += j.transpose() * noise * j;
  }
  const Matrix6 inverse = normal.inverse();
  return symmetrized(Matrix6(inverse * spread * inverse));
}

PoseCovariance rotated(const PoseCovariance& covariance, const Mat3& b_from_a) {
  Matrix6 both = Matrix6::Zero();
  both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() =
      matrix_as<Eigen::Matrix3d>(b_from_a);
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> in_a(covariance.data());
  return symmetrized(Matrix6(both * in_a * both.transpose()));
}

PoseCovariance plus_carried(const PoseCovariance& own, const PoseCovariance& other,
                            Vec3 lever_arm_m) {
  using ByRows = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  ByRows carried = ByRows::Identity();
  carried.topRightCorner<3, 3>() = -skew_as<Eigen::Matrix3d>(lever_arm_m);
  const Eigen::Map<const ByRows> of_own(own.data());
  const Eigen::Map<const ByRows> of_other(other.data());
  return symmetrized(ByRows(of_own + carried * of_other * carried.transpose()));
}

namespace {

struct Wanted {
  std::string_view family;
  int id = 0;
  [[nodiscard]] bool is(const MarkerCorners& seen) const {
    return seen.family == family && seen.id == id;
  }
};

bool is_consistent(const TagPair& pair, double size_m, const TagGeometry& geometry,
                   const MatchLimits& limits) {
  const std::optional<TagPose> pose = geometry.pose(pair, size_m);
  return pose && pose->gap_px <= limits.gap_px &&
         std::abs(pose->size_ratio - 1.0) <= limits.size_fraction &&
         pose->fit_rmse_m <= limits.size_fraction * size_m;
}

double distance_px(const TagCorners& a, const TagCorners& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += (a[i] - b[i]).norm();
  }
  return sum;
}

// Smaller is better.
double cost(const MarkerCorners& left, const MarkerCorners& right,
            const std::optional<TagPair>& expected) {
  if (!expected) {
    return -std::min(left.decision_margin, right.decision_margin);
  }
  return distance_px(left.corners_px, expected->left_px) +
         distance_px(right.corners_px, expected->right_px);
}

const MarkerCorners* best_decoded(std::span<const MarkerCorners> found, const Wanted& wanted) {
  const MarkerCorners* best = nullptr;
  for (const MarkerCorners& seen : found) {
    if (wanted.is(seen) && (!best || seen.decision_margin > best->decision_margin)) {
      best = &seen;
    }
  }
  return best;
}

}  // namespace

TagMatch matched(std::span<const MarkerCorners> left, std::span<const MarkerCorners> right,
                 std::string_view family, int id, double size_m, const TagGeometry& geometry,
                 const std::optional<TagPair>& expected, const MatchLimits& limits) {
  const Wanted wanted{family, id};
  const TagMatch alone{best_decoded(left, wanted), best_decoded(right, wanted)};
  if (!alone.both()) {
    return alone;
  }
  TagMatch match;
  double least = std::numeric_limits<double>::infinity();
  for (const MarkerCorners& a : left) {
    if (!wanted.is(a)) {
      continue;
    }
    for (const MarkerCorners& b : right) {
      if (!wanted.is(b)) {
        continue;
      }
      const double now = cost(a, b, expected);
      if (now >= least || !is_consistent({a.corners_px, b.corners_px}, size_m, geometry, limits)) {
        continue;
      }
      least = now;
      match = {&a, &b};
    }
  }
  return match;
}

std::optional<double> size_ratio(std::span<const MarkerCorners> left,
                                 std::span<const MarkerCorners> right, std::string_view family,
                                 int id, double size_m, const TagGeometry& geometry,
                                 const MatchLimits& limits) {
  const MarkerCorners* a = best_decoded(left, {family, id});
  const MarkerCorners* b = best_decoded(right, {family, id});
  if (!a || !b) {
    return std::nullopt;
  }
  const TagPair pair{a->corners_px, b->corners_px};
  const std::optional<TagPose> pose = geometry.pose(pair, size_m);
  if (!pose || !is_consistent(pair, pose->size_ratio * size_m, geometry, limits)) {
    return std::nullopt;
  }
  return pose->size_ratio;
}

namespace {

/// Unit plane from tag, with tag coordinates in half sizes; scaled so that the last entry is 1.
std::optional<Eigen::Matrix3d> homography(const std::array<Vec2, 4>& seen) {
  constexpr std::array<Vec2, 4> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  Eigen::Matrix<double, 8, 8> a = Eigen::Matrix<double, 8, 8>::Zero();
  Eigen::Matrix<double, 8, 1> b;
  for (int i = 0; i < 4; ++i) {
    const Vec2 p = kCorners[static_cast<std::size_t>(i)];
    const Vec2 u = seen[static_cast<std::size_t>(i)];
    a.row(2 * i) << p.x, p.y, 1, 0, 0, 0, -u.x * p.x, -u.x * p.y;
    a.row(2 * i + 1) << 0, 0, 0, p.x, p.y, 1, -u.y * p.x, -u.y * p.y;
    b(2 * i) = u.x;
    b(2 * i + 1) = u.y;
  }
  const Eigen::Matrix<double, 8, 1> h = a.fullPivLu().solve(b);
  if (!h.allFinite() || !(a * h).isApprox(b, 1e-6)) {
    return std::nullopt;
  }
  Eigen::Matrix3d out;
  out << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1.0;
  return out;
}

struct Adjusted {
  CameraFromTag pose;
  double squared = 0.0;  ///< what is left of the corners, on the unit plane
};

/// The pose near this one that leaves least of the corners.
Adjusted adjusted(const CameraFromTag& start, const std::array<Vec2, 4>& seen, double size_m) {
  const auto in_tag = corners_in_marker(size_m);
  const auto moved = [&](std::span<const double> by) {
    return CameraFromTag{rotation_from_vector({by[3], by[4], by[5]}) * start.rotation,
                         start.translation_m + Vec3{by[0], by[1], by[2]}};
  };
  const auto left_over = [&](std::span<const double> by, std::vector<double>& off) {
    const CameraFromTag pose = moved(by);
    off.clear();
    for (std::size_t i = 0; i < in_tag.size(); ++i) {
      const Vec3 p = pose.rotation * in_tag[i] + pose.translation_m;
      off.insert(off.end(), {p.x / p.z - seen[i].x, p.y / p.z - seen[i].y});
    }
  };
  const auto found = levenberg_marquardt(std::array<double, 6>{}, left_over);
  if (!found) {
    return {start, std::numeric_limits<double>::infinity()};
  }
  return {moved(found->parameters), found->sum_of_squares};
}

}  // namespace

std::optional<std::array<CameraFromTag, 2>> planar_poses(const std::array<Vec2, 4>& unit_plane,
                                                         double size_m) {
  const auto h = homography(unit_plane);
  if (!h) {
    return std::nullopt;
  }
  const double scale = 0.5 * (h->col(0).norm() + h->col(1).norm());
  if (!(scale > 0.0) || !std::isfinite(scale)) {
    return std::nullopt;
  }
  const auto vec = [&](int column) {
    return Vec3{(*h)(0, column), (*h)(1, column), (*h)(2, column)};
  };
  // Both axes are corrected equally to make them perpendicular.
  const Vec3 a = vec(0).normalized();
  const Vec3 b = vec(1).normalized();
  const Vec3 sum = (a + b).normalized();
  const Vec3 difference = (a - b).normalized();
  const Vec3 x = (sum + difference).normalized();
  const Vec3 y = (sum - difference).normalized();
  const Vec3 z = x.cross(y);
  const Vec3 place = (0.5 * size_m / scale) * vec(2);
  if (!z.is_finite() || !(place.z > 0.0) || !(z.dot(place) < 0.0)) {
    return std::nullopt;
  }
  const Mat3 first = Mat3::from_columns(x, y, z);
  // Depth mirrored along the line of sight, and the tag turned so that its front faces the camera
  // again.
  const Vec3 sight = place.normalized();
  const auto mirrored = [&](Vec3 v) { return v - 2.0 * v.dot(sight) * sight; };
  const Mat3 other = Mat3::from_columns(mirrored(x), mirrored(y), -mirrored(z));
  const Adjusted one = adjusted({first, place}, unit_plane, size_m);
  const Adjusted two = adjusted({other, place}, unit_plane, size_m);
  return two.squared < one.squared ? std::array<CameraFromTag, 2>{two.pose, one.pose}
                                   : std::array<CameraFromTag, 2>{one.pose, two.pose};
}

std::optional<std::array<Transform<Rig, Tag>, 2>> poses_by_one(const StereoCalibration& calibration,
                                                               const MarkerCorners& seen,
                                                               bool right, double size_m) {
  const CameraModel& camera = right ? calibration.right : calibration.left;
  std::array<Vec2, 4> unit_plane;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto direction = camera.unproject(seen.corners_px[k]);
    if (!direction) {
      return std::nullopt;
    }
    unit_plane[k] = *direction;
  }
  const auto poses = planar_poses(unit_plane, size_m);
  if (!poses) {
    return std::nullopt;
  }
  const auto in_rig = [&](const CameraFromTag& p) -> Transform<Rig, Tag> {
    if (right) {
      return calibration.right_from_rig.inverse() *
             Transform<RightCamera, Tag>(p.rotation, p.translation_m);
    }
    return calibration.left_from_rig.inverse() *
           Transform<LeftCamera, Tag>(p.rotation, p.translation_m);
  };
  return std::array<Transform<Rig, Tag>, 2>{in_rig((*poses)[0]), in_rig((*poses)[1])};
}

}  // namespace orthonav::nav
