#include "nav/tracking/planar_pose.h"

#include <cmath>
#include <Eigen/Dense>
#include <limits>
#include <span>
#include <vector>

#include "nav/statistics/levenberg_marquardt.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::nav {
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
