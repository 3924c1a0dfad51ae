#include "engine/evaluation/shaft_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/evaluation/border_voxels.h"
#include "engine/evaluation/shaft_model.h"
#include "nav/statistics/levenberg_marquardt.h"

namespace orthonav::engine {
namespace {

constexpr double kMaxMoved_m = 0.003;  ///< from where the search put it

/// The unknowns, in the order of the parameters; metres and radians.
enum Parameter : std::size_t {
  kAcross,
  kAthwart,
  kRotationAcross,
  kRotationAthwart,
  kRadius,
  kBlur,
  kTip,
  kRear,
  kBowAcross,
  kBowAthwart,
  kParameters
};
using Parameters = std::array<double, kParameters>;

/// The shaft with its parameters changed.
Shaft changed(const Shaft& start, std::span<const double> p) {
  Shaft out = start;
  Centreline& line = out.line;
  line.middle_m += p[kAcross] * line.across + p[kAthwart] * line.athwart;
  line.direction =
      (line.direction + p[kRotationAcross] * line.across + p[kRotationAthwart] * line.athwart)
          .normalized();
  line.across = (line.across - line.across.dot(line.direction) * line.direction).normalized();
  line.athwart = line.direction.cross(line.across);
  out.radius_m = p[kRadius];
  out.to_s_m += p[kTip];
  out.from_s_m += p[kRear];
  line.bow_across_m += p[kBowAcross];
  line.bow_athwart_m += p[kBowAthwart];
  return out;
}

/// The share of metal that a blurred shaft has at a place.
double fraction_at(const Shaft& shaft, double blur_m, Vec3 place_m) {
  const double s = shaft.line.s_of(place_m);
  const double off_m = (place_m - shaft.line.at(s)).norm();
  double fraction = share_across(shaft.radius_m, off_m, blur_m);
  if (!shaft.goes_on) {
    fraction *= share_before_end(s - shaft.from_s_m, blur_m);
  }
  if (!shaft.cut) {
    fraction *= share_before_end(shaft.to_s_m - s, blur_m);
  }
  return fraction;
}

void write_misfits(const std::vector<BorderVoxel>& voxels, const ShaftModel& model,
                   const Shaft& shaft, double blur_m, std::vector<double>& out) {
  out.clear();
  const double parts = static_cast<double>(model.places_m.size());
  for (const BorderVoxel& voxel : voxels) {
    double fraction = 0.0;
    for (const Vec3& part : model.places_m) {
      fraction += fraction_at(shaft, blur_m, voxel.place_m + part);
    }
    out.push_back(model.misfit(voxel.hu, fraction / parts));
  }
}

/// The covariance of place and direction. Neighbouring voxels share noise and streaks, so a voxel
/// counts for a sixth of one; and what streaks do to a whole side does not show in any misfit. They
/// differ from slice to slice, so they turn an axis towards the normal of the slices: in computed
/// scans by 0.085° over 40 mm (SD), and by a quarter of that within the slices.
std::array<double, 16> axis_covariance(const nav::LeastSquares& found, std::size_t voxels,
                                       const Centreline& line, Vec3 slice_normal) {
  constexpr double kSharing = 1.5;
  constexpr double kStreaks_m = 1e-5;
  constexpr double kStreaks_rad = 0.0018;
  constexpr double kWithinSlices = 0.25;
  constexpr double kStreaksHalf_m = 0.020;
  const double scale = std::max(0.1, found.sum_of_squares / static_cast<double>(voxels));
  const double turn_rad = kStreaks_rad * kStreaksHalf_m / line.half_m;
  const std::array<double, 2> normal{slice_normal.dot(line.across), slice_normal.dot(line.athwart)};
  std::array<double, 16> out{};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      out[4 * row + column] = kSharing * scale * found.covariance[row * kParameters + column];
    }
    const double floor = row < 2 ? kStreaks_m : kWithinSlices * turn_rad;
    out[5 * row] += floor * floor;
  }
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t column = 0; column < 2; ++column) {
      out[4 * (row + 2) + column + 2] += turn_rad * turn_rad * normal[row] * normal[column];
    }
  }
  return out;
}

/// The part of a shaft that is fitted: only the front of a long wire, since it may bend in any way
/// behind the bone.
Shaft front_part(const Shaft& shaft) {
  constexpr double kFront_m = 0.055;
  Shaft out = shaft;
  out.goes_on = shaft.headed;
  if (!shaft.is_wire() || shaft.length_m() <= kFront_m) {
    return out;
  }
  const double middle_s = shaft.to_s_m - 0.5 * kFront_m;
  const double part = 0.5 * kFront_m / shaft.line.half_m;
  out.line =
      Centreline::straight(shaft.line.at(middle_s), shaft.line.tangent(middle_s), 0.5 * kFront_m);
  const Vec3 bow_m =
      part * part *
      (shaft.line.bow_across_m * shaft.line.across + shaft.line.bow_athwart_m * shaft.line.athwart);
  out.line.bow_across_m = bow_m.dot(out.line.across);
  out.line.bow_athwart_m = bow_m.dot(out.line.athwart);
  out.from_s_m = -0.5 * kFront_m;
  out.to_s_m = 0.5 * kFront_m;
  out.goes_on = true;
  return out;
}

/// The shaft with these parameters, clamped to their limits.
Shaft limited(const Shaft& shaft, std::span<const double> p) {
  Parameters used{};
  std::copy(p.begin(), p.end(), used.begin());
  used[kRadius] = std::clamp(used[kRadius], 3e-4, 7e-3);
  used[kTip] = std::clamp(used[kTip], -kMaxMoved_m, kMaxMoved_m);
  used[kRear] = std::clamp(used[kRear], -kMaxMoved_m, kMaxMoved_m);
  if (!shaft.is_wire()) {
    used[kBowAcross] = used[kBowAthwart] = 0.0;
  }
  return changed(shaft, used);
}

Result<nav::LeastSquares> best_parameters(const Shaft& shaft, const ShaftModel& model,
                                          const std::vector<BorderVoxel>& voxels) {
  constexpr double kBlurSpread_m = 0.00015;
  constexpr double kBlurWeight = 10.0;
  constexpr int kRounds = 15;
  Parameters start{};
  start[kRadius] = shaft.radius_m;
  start[kBlur] = kUsualBlur_m;
  return nav::levenberg_marquardt(
      start,
      [&](std::span<const double> p, std::vector<double>& out) {
        write_misfits(voxels, model, limited(shaft, p), std::clamp(p[kBlur], 2e-4, 1.5e-3), out);
        // When metal is clipped, a blurred thin shaft looks much like a sharp thick one.
        out.push_back(kBlurWeight * (p[kBlur] - kUsualBlur_m) / kBlurSpread_m);
      },
      kRounds);
}

}  // namespace

std::optional<Shaft> fitted_shaft(const ScanField& scan, const Shaft& found_shaft,
                                  std::span<const Shaft> others) {
  constexpr std::size_t kFewest = 40;
  constexpr double kMostRotation_rad = 0.15;
  const Shaft shaft = front_part(found_shaft);
  const std::vector<BorderVoxel> voxels = border_voxels(scan, shaft, others);
  if (voxels.size() < kFewest) {
    return std::nullopt;
  }
  auto best = best_parameters(shaft, shaft_model(scan, voxels, shaft), voxels);
  if (!best) {
    return std::nullopt;
  }
  // An end that moves far was not seen, as where two tips touch: it stays where the search put it.
  for (const std::size_t end : {kTip, kRear}) {
    if (std::abs(best->parameters[end]) > 0.9 * kMaxMoved_m) {
      best->parameters[end] = 0.0;
    }
  }
  Shaft out = limited(shaft, best->parameters);
  if ((out.line.middle_m - shaft.line.middle_m).norm() > kMaxMoved_m ||
      angle_between_rad(out.line.direction, shaft.line.direction) > kMostRotation_rad) {
    return std::nullopt;
  }
  const auto count = static_cast<double>(voxels.size());
  out.misfit_hu = kNoise_hu * std::sqrt(best->sum_of_squares / count);
  out.covariance =
      axis_covariance(*best, voxels.size(), out.line, scan.grid().directions * Vec3{0, 0, 1});
  return out;
}

}  // namespace orthonav::engine
