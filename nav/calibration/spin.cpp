#include "nav/calibration/spin.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/angle.h"
#include "base/findings.h"
#include "base/joined.h"
#include "base/printed.h"
#include "base/random.h"
#include "nav/calibration/spin_fit.h"
#include "nav/statistics/consensus.h"

namespace orthonav::nav {
namespace {

using SpinPoses = std::span<const Transform<World, Marker>>;
using SpinConsensus = Consensus<SpinFit>;

constexpr std::size_t kSpinMinPoses = 20;
/// Least `spread`: turning evenly over 60° has 0.3, over 90° 0.44, over 120° 0.56.
constexpr double kSpinMinSpread = 0.3;
/// A pose whose axis deviates by more from the common one is not an inlier; if the poses scatter
/// less, the limit shrinks with them.
constexpr double kSpinInlier_rad = 0.035;
constexpr double kSpinMinInlierFraction = 0.6;
/// The axis about which the tool turned must lie within this angle of the tool's given axis;
/// otherwise it was a different movement.
constexpr double kSpinMaxOff_rad = 0.26;
constexpr double kSpinMaxWobble_rad = 0.02;
constexpr double kSpinMaxAxisSigma_rad = 0.0087;  ///< 0.5°
/// Limits beyond which a result gets a note.
constexpr double kSpinNoteSpread = 0.44;
constexpr double kSpinNoteAxisSigma_rad = 0.0035;  ///< 0.2°
constexpr double kSpinNoteTipBeside_m = 0.001;
constexpr int kSpinRounds = 500;  ///< random samples tried
constexpr std::uint64_t kSpinSeed = 1;
constexpr std::size_t kSpinSample = 2;
// Half of the axes that scatter normally with SD s in each of two directions lie within 1.177 s.
constexpr double kMedianOfRayleigh = 1.177;
constexpr double kLeastInlierRad = 1e-3;
// Two poses of a sample are turned so far against each other: a smaller turn has no clear axis, and
// about half a turn has none either.
constexpr double kLeastRotation_rad = 0.35;
constexpr double kMostRotation_rad = 2.8;

Error spin_refused(const char* format, double value, double limit) {
  return Error{"axis calibration: " + with_numbers(format, value, limit)};
}

/// The direction along the same line that points to the side of `like`.
Vec3 on_the_side_of(Vec3 like, Vec3 axis) { return like.dot(axis) < 0.0 ? -axis : axis; }

std::optional<SpinFit> sampled_spin(SpinPoses poses, Vec3 given, double most_off_rad,
                                    Random& random) {
  const auto any = [&] {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(poses.size()));
  };
  const Mat3& first = poses[any()].rotation();
  const Mat3& second = poses[any()].rotation();
  const Vec3 rotation_rad = vector_from_rotation(first.transposed() * second);
  if (!(rotation_rad.norm() >= kLeastRotation_rad && rotation_rad.norm() <= kMostRotation_rad)) {
    return std::nullopt;
  }
  SpinFit fit;
  fit.axis_in_marker = on_the_side_of(given, rotation_rad.normalized());
  fit.axis_in_world = first * fit.axis_in_marker;
  if (angle_between_rad(fit.axis_in_marker, given) > most_off_rad) {
    return std::nullopt;
  }
  return fit;
}

SpinConsensus consensus_of(SpinPoses poses, Vec3 given) {
  return {poses.size(),
          [poses](std::span<const std::size_t> chosen) { return fit_spin(poses, chosen); },
          [poses](const SpinFit& fit, std::size_t i) { return fit.miss_rad(poses[i]); },
          [poses, given, most_off_rad = kSpinMaxOff_rad](Random& random) {
            return sampled_spin(poses, given, most_off_rad, random);
          },
          kSpinInlier_rad,
          kLeastInlierRad,
          kMedianOfRayleigh};
}

Status check_poses(SpinPoses poses) {
  if (poses.size() < kSpinMinPoses) {
    return spin_refused("%.0f poses, at least %.0f are needed", static_cast<double>(poses.size()),
                        static_cast<double>(kSpinMinPoses));
  }
  for (const auto& pose : poses) {
    for (const double number : pose.row_major()) {
      if (!std::isfinite(number)) {
        return Error{"axis calibration: a pose is not finite"};
      }
    }
  }
  return {};
}

double agreeing(const SpinCalibration& found) {
  return static_cast<double>(found.inliers) / static_cast<double>(found.poses);
}

Status check_result(const SpinCalibration& found) {
  if (!(agreeing(found) >= kSpinMinInlierFraction) || found.inliers < kSpinMinPoses) {
    return spin_refused("%.0f %% of the poses agree on an axis, at least %.0f %% are needed",
                        100.0 * agreeing(found), 100.0 * kSpinMinInlierFraction);
  }
  if (!(found.off_rad <= kSpinMaxOff_rad)) {
    return spin_refused(
        "the tool turned about an axis %.1f° from its own, limit %.1f° (was it spun "
        "about its shaft?)",
        degrees(found.off_rad), degrees(kSpinMaxOff_rad));
  }
  if (!(found.spread >= kSpinMinSpread)) {
    return spin_refused("the tool turned by %.2f, at least %.2f is needed (60° evenly)",
                        found.spread, kSpinMinSpread);
  }
  if (!(found.wobble_rad <= kSpinMaxWobble_rad)) {
    return spin_refused("the axis wobbled by %.2f° RMS, limit %.2f°", degrees(found.wobble_rad),
                        degrees(kSpinMaxWobble_rad));
  }
  if (!(found.axis_sigma_rad <= kSpinMaxAxisSigma_rad)) {
    return spin_refused("the axis is known to %.2f°, limit %.2f° (turn it further, for longer)",
                        degrees(found.axis_sigma_rad), degrees(kSpinMaxAxisSigma_rad));
  }
  return {};
}

Judgement judged(const SpinCalibration& found) {
  Judgement judgement;
  if (found.spread < kSpinNoteSpread) {
    judgement.add(Verdict::kNote, with_numbers("turned by %.2f only, better %.2f (90° evenly)",
                                               found.spread, kSpinNoteSpread));
  }
  if (found.axis_sigma_rad > kSpinNoteAxisSigma_rad) {
    judgement.add(Verdict::kNote,
                  with_numbers("the axis is known to %.2f° only, better %.2f°",
                               degrees(found.axis_sigma_rad), degrees(kSpinNoteAxisSigma_rad)));
  }
  if (found.tip_beside_m.norm() > kSpinNoteTipBeside_m) {
    judgement.add(Verdict::kNote,
                  with_numbers("the tip lies %.2f mm beside that axis, better %.2f",
                               found.tip_beside_m.norm() * 1e3, kSpinNoteTipBeside_m * 1e3));
  }
  judgement.conclude();
  return judgement;
}

}  // namespace

Result<SpinCalibration> spin_calibration(SpinPoses poses, Point<Marker> tip,
                                         Direction<Marker> axis) {
  if (Status status = check_poses(poses); !status) {
    return status.error();
  }
  const SpinConsensus consensus = consensus_of(poses, axis.v);
  Random random(kSpinSeed);
  std::optional<SpinFit> fit = consensus.best(kSpinRounds, random);
  if (!fit) {
    return spin_refused("the tool turned by %.2f, at least %.2f is needed (60° evenly)", 0.0,
                        kSpinMinSpread);
  }
  const auto inliers = consensus.settle(*fit);
  SpinCalibration found;
  found.axis_in_marker = {on_the_side_of(axis.v, fit->axis_in_marker)};
  found.off_rad = angle_between_rad(found.axis_in_marker.v, axis.v);
  found.wobble_rad = fit->wobble_rad;
  found.spread = fit->spread;
  found.poses = poses.size();
  found.inliers = inliers.size();
  if (inliers.size() > kJackknifeBlocks) {
    std::vector<Vec3> axes;
    for (const SpinFit& without : consensus.without_each_block(inliers)) {
      axes.push_back(on_the_side_of(axis.v, without.axis_in_marker));
    }
    found.leave_out_rad = jackknife_sd(axes);
  }
  found.axis_sigma_rad = std::max(fit->axis_sigma_rad, found.leave_out_rad);
  if (Status status = check_result(found); !status) {
    return status.error();
  }
  found.tip_beside_m = beside_axis_m(poses, inliers, *fit, tip);
  found.judgement = judged(found);
  return found;
}

}  // namespace orthonav::nav
