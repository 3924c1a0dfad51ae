#include "nav/registration/tre.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Core>
#include <tuple>
#include <vector>

#include "base/random.h"
#include "base/reason.h"
#include "base/translation.h"
#include "nav/registration/registration.h"
#include "nav/statistics/symmetric_eigen.h"

namespace orthonav::nav {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kCorrelation_m = 0.005;
/// The least visible motion may be this much less visible than the most visible one.
constexpr double kWeakest = 1e-6;
/// Rotations are compared with translations at this lever arm.
constexpr double kLever_m = 0.03;

struct Touch {
  std::array<long, 3> cell;
  Vec3 at_m;
  Vec3 normal;
  double distance_m;
};

std::vector<Touch> touches(const VertebraModel& model, const Transform<World, Vertebra>& pose,
                           std::span<const Point<World>> points) {
  const Transform<Vertebra, World> inverse = pose.inverse();
  std::vector<Touch> found;
  for (const Point<World>& point : points) {
    const auto surface = model.reachable_surface().nearest((inverse * point).v);
    if (!surface) {
      continue;
    }
    const Vec3 p = surface->point_m;
    const auto cell = [](double x) { return std::lround(x / kCorrelation_m); };
    found.push_back({{cell(p.x), cell(p.y), cell(p.z)}, p, surface->normal, surface->distance_m});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Touch& a, const Touch& b) { return a.cell < b.cell; });
  return found;
}

/// The derivative of a touch's residual by (translation, rotation · lever arm).
Vector6 derivative(const Touch& touch, Vec3 centre_m) {
  const Vec3 by_rotation = (touch.at_m - centre_m).cross(touch.normal) / kLever_m;
  Vector6 j;
  j << touch.normal.x, touch.normal.y, touch.normal.z, by_rotation.x, by_rotation.y, by_rotation.z;
  return j;
}

/// All touches of a cell together count as one.
Matrix6 information(const std::vector<Touch>& sorted, Vec3 centre_m) {
  Matrix6 sum = Matrix6::Zero();
  for (std::size_t i = 0; i < sorted.size();) {
    Matrix6 cell = Matrix6::Zero();
    std::size_t j = i;
    for (; j < sorted.size() && sorted[j].cell == sorted[i].cell; ++j) {
      const Vector6 d = derivative(sorted[j], centre_m);
      cell += d * d.transpose();
    }
    sum += cell / static_cast<double>(j - i);
    i = j;
  }
  return sum;
}

}  // namespace

Result<PoseUncertainty> PoseUncertainty::estimate(
    const VertebraModel& model, const Transform<World, Vertebra>& world_from_vertebra,
    std::span<const Point<World>> points_in_world) {
  const std::vector<Touch> found = touches(model, world_from_vertebra, points_in_world);
  if (found.size() <= 6) {
    return refused(
        {translatable("predicted error needs more than 6 points, got %zu"), {found.size()}});
  }
  const auto n = static_cast<double>(found.size());
  PoseUncertainty result;
  double squares_m2 = 0.0;
  for (const Touch& touch : found) {
    result.centre_m_ += touch.at_m / n;
    squares_m2 += touch.distance_m * touch.distance_m;
  }
  const Matrix6 info = information(found, result.centre_m_);
  std::array<double, 36> entries{};
  Eigen::Map<Matrix6>(entries.data()) = info;
  const SymmetricEigen6 eigen = symmetric_eigen(entries);
  if (!(eigen.values[0] > kWeakest * eigen.values[5])) {
    return refused(
        {translatable("the digitized points leave a motion of the bone open: digitize "
                      "another side of it")});
  }
  Vector6 scale;  // back from rotation · lever arm to rotation
  scale << 1, 1, 1, 1 / kLever_m, 1 / kLever_m, 1 / kLever_m;
  const Eigen::Map<const Matrix6> vectors(eigen.vectors.data());
  const Eigen::Map<const Vector6> values(eigen.values.data());
  const Matrix6 inverse = vectors * values.cwiseInverse().asDiagonal() * vectors.transpose();
  const Matrix6 covariance =
      (squares_m2 / (n - 6.0)) * scale.asDiagonal() * inverse * scale.asDiagonal();
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c < 6; ++c) {
      result.covariance_[static_cast<std::size_t>(6 * r + c)] = covariance(r, c);
    }
  }
  return result;
}

std::array<double, 9> PoseUncertainty::covariance_at(Point<Vertebra> target) const {
  const Matrix6 covariance =
      Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(covariance_.data());
  const Vec3 d = target.v - centre_m_;
  Eigen::Matrix<double, 3, 6> moves =
      Eigen::Matrix<double, 3, 6>::Zero();  // translation + rotation × d
  moves.leftCols<3>().setIdentity();
  moves.rightCols<3>() << 0, d.z, -d.y, -d.z, 0, d.x, d.y, -d.x, 0;
  std::array<double, 9> out{};
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(out.data()) =
      moves * covariance * moves.transpose();
  return out;
}

double PoseUncertainty::predicted_tre_m(Point<Vertebra> target) const {
  const std::array<double, 9> c = covariance_at(target);
  return std::sqrt(std::max(0.0, c[0] + c[4] + c[8]));
}

double PoseUncertainty::tre_quantile_m(Point<Vertebra> target, double probability) const {
  const std::array<double, 9> c = covariance_at(target);
  const double mean = c[0] + c[4] + c[8];
  double squares = 0.0;
  for (const double v : c) {
    squares += v * v;
  }
  if (!(mean > 0.0)) {
    return 0.0;
  }
  const double freedom = mean * mean / squares;
  const double k = 2.0 / (9.0 * freedom);
  const double root = std::max(0.0, 1.0 - k + normal_quantile(probability) * std::sqrt(k));
  return std::sqrt(mean * root * root * root);
}

double CommonErrors::sd_m() const { return std::hypot(tip_m, cameras_m, map_m); }

namespace {
PoseUncertainty with_position_variance(const PoseUncertainty& uncertainty, double variance_m2) {
  auto covariance = uncertainty.covariance();
  for (std::size_t k = 0; k < 3; ++k) {
    covariance[7 * k] += variance_m2;
  }
  return {uncertainty.centre_m(), covariance};
}
}  // namespace

PoseUncertainty with_common(const PoseUncertainty& own, const CommonErrors& common) {
  return with_position_variance(own, common.sd_m() * common.sd_m());
}
PoseUncertainty with_turn(const PoseUncertainty& own, Point<Vertebra> about, Vec3 axis,
                          double sd_rad) {
  // A rotation w about a place p is w about the centre c plus the shift w x (c - p): two columns,
  // one for each direction across.
  auto covariance = own.covariance();
  const Vec3 any = std::abs(axis[0]) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = axis.cross(any).normalized();
  for (const Vec3 rotation : {across, axis.cross(across)}) {
    const Vec3 translation = rotation.cross(own.centre_m() - about.v);
    const std::array<double, 6> column = {translation[0], translation[1], translation[2],
                                          rotation[0],    rotation[1],    rotation[2]};
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c < 6; ++c) {
        covariance[6 * r + c] += sd_rad * sd_rad * column[r] * column[c];
      }
    }
  }
  return {own.centre_m(), covariance};
}

PoseUncertainty without_common(const PoseUncertainty& all, const CommonErrors& common) {
  return with_position_variance(all, -common.sd_m() * common.sd_m());
}

}  // namespace orthonav::nav
