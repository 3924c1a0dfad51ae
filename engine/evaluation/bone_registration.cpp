#include "engine/evaluation/bone_registration.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <string>

#include "base/printed.h"
#include "nav/statistics/median.h"

namespace orthonav::engine {
namespace {

/// Limits beyond which a fit is refused. Another vertebra of the same spine fits with 0.37 mm and
/// more, and with a coverage of 0.90 at most; the right one with 0.06 to 0.14 mm and 0.93 or more.
constexpr double kMaxResidual_m = 0.00025;
constexpr double kLeastCoverage = 0.85;
constexpr double kLeastEdges = 150;

using Matrix7 = Eigen::Matrix<double, 7, 7>;
using Vector7 = Eigen::Matrix<double, 7, 1>;

constexpr double kMaxOffset_m = 0.001;

Vec3 centre_of(const std::vector<SurfaceSample>& samples) {
  Vec3 sum;
  for (const SurfaceSample& sample : samples) {
    sum += sample.place_m;
  }
  return sum / static_cast<double>(samples.size());
}

/// How an edge's distance decreases with a motion (t, w) of the vertebra about its centre, in its
/// frame.
Vector7 gradient_of(const SurfaceSample& sample, Vec3 centre_m) {
  const Vec3 arm = (sample.place_m - centre_m).cross(sample.normal);
  Vector7 out;
  out << sample.normal.x, sample.normal.y, sample.normal.z, arm.x, arm.y, arm.z, 1.0;
  return out;
}

struct Equations {
  Matrix7 information = Matrix7::Zero();
  Vector7 right = Vector7::Zero();
  double squares_m2 = 0.0;
  double weights = 0.0;
};

Equations equations_of(const std::vector<SurfaceSample>& samples, Vec3 centre_m,
                       const BoneEdges& seen, double offset_m, double width_m) {
  Equations out;
  for (const BoneEdges::Edge& edge : seen.edges) {
    const double off_m = edge.outward_m - offset_m;
    const double q = off_m / width_m;
    if (std::abs(q) >= 1.0) {
      continue;
    }
    const double weight = (1.0 - q * q) * (1.0 - q * q);
    const Vector7 gradient = gradient_of(samples[edge.sample], centre_m);
    out.information += weight * gradient * gradient.transpose();
    out.right += weight * off_m * gradient;
    out.squares_m2 += weight * off_m * off_m;
    out.weights += weight;
  }
  return out;
}

Transform<Scan, Vertebra> moved(const Transform<Scan, Vertebra>& pose, Vec3 centre_m,
                                const Vector7& step) {
  const Mat3 rotation = rotation_from_vector({step[3], step[4], step[5]});
  const Vec3 translation = centre_m + Vec3{step[0], step[1], step[2]} - rotation * centre_m;
  return {orthonormalized(pose.rotation() * rotation),
          pose.rotation() * translation + pose.translation()};
}

/// The pose's covariance. Neighbouring edges share streaks, blur and the model's own error: an edge
/// counts for a quarter of one.
nav::PoseUncertainty uncertainty_of(const Equations& equations, Vec3 centre_m) {
  constexpr double kSharing = 4.0;
  const double variance_m2 =
      std::max(equations.squares_m2 / std::max(equations.weights, 1.0), 1e-9);
  const Matrix7 covariance = kSharing * variance_m2 * equations.information.inverse();
  std::array<double, 36> out{};
  for (Eigen::Index i = 0; i < 36; ++i) {
    out[static_cast<std::size_t>(i)] = covariance(i / 6, i % 6);
  }
  return {centre_m, out};
}

bool is_determined(const Equations& equations) {
  // Metres and radians count alike at a lever of 20 mm.
  Vector7 scale;
  scale << 1.0, 1.0, 1.0, 50.0, 50.0, 50.0, 1.0;
  const Matrix7 scaled = scale.asDiagonal() * equations.information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix7> eigen(scaled, Eigen::EigenvaluesOnly);
  return equations.weights > 20.0 && eigen.eigenvalues()(0) > 0.003 * equations.weights;
}

/// Fills in the figures at the end and judges them.
void judge(const BoneEdges& seen, std::size_t samples, BoneRegistration& out) {
  constexpr double kNear_m = 0.001;
  std::vector<double> off_m;
  for (const BoneEdges::Edge& edge : seen.edges) {
    off_m.push_back(std::abs(edge.outward_m - out.offset_m));
  }
  const auto near =
      std::count_if(off_m.begin(), off_m.end(), [&](double off) { return off < kNear_m; });
  out.edges = off_m.size();
  out.coverage =
      static_cast<double>(near) / static_cast<double>(std::max<std::size_t>(1, seen.looked_for));
  out.inside_scan = 1.0 - static_cast<double>(seen.outside) / static_cast<double>(samples);
  out.residual_m = off_m.empty() ? 0.0 : nav::median(std::move(off_m));
}

}  // namespace

BoneRegistration laid_on_bone(const ScanField& scan, const MetalMask& mask,
                              const std::vector<SurfaceSample>& samples,
                              const Transform<Scan, Vertebra>& start, double within_m) {
  constexpr double kLastWithin_m = 0.0015;
  constexpr double kNarrowing = 0.8;
  constexpr int kLastRounds = 4;
  const Vec3 centre_m = centre_of(samples);
  BoneRegistration out{start};
  BoneEdges seen;
  int last_rounds = 0;
  for (double within = within_m; last_rounds < kLastRounds;
       within = std::max(kLastWithin_m, kNarrowing * within)) {
    seen = bone_edges(scan, mask, samples, out.scan_from_vertebra, within);
    const Equations equations = equations_of(samples, centre_m, seen, out.offset_m, within);
    if (!is_determined(equations)) {
      judge(seen, samples.size(), out);
      out.coverage = 0.0;
      return out;
    }
    const Vector7 step = equations.information.ldlt().solve(equations.right);
    out.scan_from_vertebra = moved(out.scan_from_vertebra, centre_m, step);
    out.offset_m = std::clamp(out.offset_m + step[6], -kMaxOffset_m, kMaxOffset_m);
    out.uncertainty = uncertainty_of(equations, centre_m);
    last_rounds += within == kLastWithin_m ? 1 : 0;
  }
  judge(seen, samples.size(), out);
  return out;
}

std::string refusal(const BoneRegistration& found) {
  if (found.inside_scan < kLeastInsideScan) {
    return printed("%.0f %% of the vertebra lie in the scan, limit %.0f %%",
                   found.inside_scan * 1e2, kLeastInsideScan * 1e2);
  }
  if (static_cast<double>(found.edges) < kLeastEdges) {
    return printed("%.0f places of its surface are seen clear of metal, limit %.0f",
                   static_cast<double>(found.edges), kLeastEdges);
  }
  if (found.coverage < kLeastCoverage) {
    return printed(
        "%.0f %% of its surface lie within 1 mm of bone in the scan, limit %.0f %%: another "
        "vertebra, or a coarse model",
        found.coverage * 1e2, kLeastCoverage * 1e2);
  }
  if (found.residual_m > kMaxResidual_m) {
    return printed(
        "its surface lies %.2f mm off the bone in the scan, limit %.2f mm: another vertebra, or a "
        "coarse model",
        found.residual_m * 1e3, kMaxResidual_m * 1e3);
  }
  return "";
}

}  // namespace orthonav::engine
