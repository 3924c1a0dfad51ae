#include "engine/evaluation/shaft_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/evaluation/border_voxels.h"
#include "nav/statistics/levenberg_marquardt.h"
#include "nav/statistics/median.h"

namespace orthonav::engine {
namespace {

constexpr double kLow_hu = 1300.0;   ///< bone and most streaks are below
constexpr double kClip_hu = 3071.0;  ///< of 12 bits
constexpr double kTitanium_hu = 8000.0;
constexpr double kSteel_hu = 12000.0;  ///< of wires
constexpr double kAround_hu = 300.0;
constexpr double kNoise_hu = 80.0;  ///< SD of a voxel's misfit, as assumed
constexpr double kUsualBlur_m = 0.0005;
constexpr double kMostMoved_m = 0.003;  ///< from where the search put it

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

double normal_cdf(double x) { return 0.5 * std::erfc(-x * 0.70710678118654752); }

/// The share of metal that a blurred shaft has at a place.
double fraction_at(const Shaft& shaft, double blur_m, Vec3 place_m) {
  const double s = shaft.line.s_of(place_m);
  const double off_m = (place_m - shaft.line.at(s)).norm();
  double fraction = normal_cdf((shaft.radius_m - off_m) / blur_m);
  if (!shaft.goes_on) {
    fraction *= normal_cdf((s - shaft.from_s_m) / blur_m);
  }
  if (!shaft.cut) {
    fraction *= normal_cdf((shaft.to_s_m - s) / blur_m);
  }
  // A flat border would keep its full height; a thin cylinder is blurred from all sides.
  const double q = shaft.radius_m / blur_m;
  return fraction * (1.0 - std::exp(-0.5 * q * q)) / normal_cdf(q);
}

/// Where the model is sampled in a voxel, from its middle: more places along its longer sides.
std::vector<Vec3> places_in_voxel(const VolumeGrid& grid) {
  std::array<int, 3> parts{};
  for (int a = 0; a < 3; ++a) {
    parts[static_cast<std::size_t>(a)] =
        std::clamp(static_cast<int>(std::ceil(grid.spacing_m[a] / 0.0006 - 0.2)), 1, 5);
  }
  std::vector<Vec3> out;
  for (int i = 0; i < parts[0]; ++i) {
    for (int j = 0; j < parts[1]; ++j) {
      for (int k = 0; k < parts[2]; ++k) {
        const Vec3 part{(i + 0.5) / parts[0] - 0.5, (j + 0.5) / parts[1] - 0.5,
                        (k + 0.5) / parts[2] - 0.5};
        out.push_back(grid.directions * Vec3{part.x * grid.spacing_m.x, part.y * grid.spacing_m.y,
                                             part.z * grid.spacing_m.z});
      }
    }
  }
  return out;
}

/// Misfits that are much larger than the noise count for less (Cauchy).
double soft(double misfit) {
  constexpr double kWidth = 3.0;
  const double q = misfit / kWidth;
  return std::copysign(kWidth * std::sqrt(std::log1p(q * q)), misfit);
}

/// How the model's voxels are computed.
struct Rendering {
  double metal_hu = kTitanium_hu;
  double highest_hu = kClip_hu;
  std::vector<Vec3> places_m;  ///< in a voxel
};

Rendering rendering_of(const ScanField& scan, const std::vector<BorderVoxel>& voxels,
                       const Shaft& shaft) {
  Rendering out;
  out.places_m = places_in_voxel(scan.grid());
  out.metal_hu = shaft.is_wire() ? kSteel_hu : kTitanium_hu;
  std::vector<double> core;
  for (const BorderVoxel& voxel : voxels) {
    if (shaft.line.off_m(voxel.place_m) < 0.7 * shaft.radius_m && voxel.hu > kMetal_hu) {
      core.push_back(voxel.hu);
    }
  }
  const double core_hu = core.empty() ? 0.0 : nav::median(std::move(core));
  // A scan that does not clip shows the metal's own density.
  if (core_hu > kClip_hu + 200.0) {
    out.metal_hu = core_hu;
    out.highest_hu = 0.9 * out.metal_hu;
  }
  return out;
}

void write_misfits(const std::vector<BorderVoxel>& voxels, const Rendering& how, const Shaft& shaft,
                   double blur_m, std::vector<double>& out) {
  out.clear();
  const double parts = static_cast<double>(how.places_m.size());
  for (const BorderVoxel& voxel : voxels) {
    double fraction = 0.0;
    for (const Vec3& part : how.places_m) {
      fraction += fraction_at(shaft, blur_m, voxel.place_m + part);
    }
    const double model_hu = kAround_hu + fraction / parts * (how.metal_hu - kAround_hu);
    const double misfit_hu = std::clamp(voxel.hu, kLow_hu, how.highest_hu) -
                             std::clamp(model_hu, kLow_hu, how.highest_hu);
    out.push_back(soft(misfit_hu / kNoise_hu));
  }
}

/// The covariance of place and direction. Neighbouring voxels share noise and streaks, so a voxel
/// counts for a sixth of one; and what streaks do to a whole side does not show in any misfit: in
/// computed scans they move an axis by 0.06 mm and turn it by 0.075° over 40 mm (SD, each way).
std::array<double, 16> axis_covariance(const nav::LeastSquares& found, std::size_t voxels,
                                       double half_m) {
  constexpr double kSharing = 6.0;
  constexpr double kStreaks_m = 6e-5;
  constexpr double kStreaks_rad = 0.0013;
  constexpr double kStreaksHalf_m = 0.020;
  const double scale = std::max(0.1, found.sum_of_squares / static_cast<double>(voxels));
  std::array<double, 16> out{};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      out[4 * row + column] = kSharing * scale * found.covariance[row * kParameters + column];
    }
    const double floor = row < 2 ? kStreaks_m : kStreaks_rad * kStreaksHalf_m / half_m;
    out[5 * row] += floor * floor;
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
  used[kTip] = std::clamp(used[kTip], -kMostMoved_m, kMostMoved_m);
  used[kRear] = std::clamp(used[kRear], -kMostMoved_m, kMostMoved_m);
  if (!shaft.is_wire()) {
    used[kBowAcross] = used[kBowAthwart] = 0.0;
  }
  return changed(shaft, used);
}

Result<nav::LeastSquares> best_parameters(const Shaft& shaft, const Rendering& how,
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
        write_misfits(voxels, how, limited(shaft, p), std::clamp(p[kBlur], 2e-4, 1.5e-3), out);
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
  auto best = best_parameters(shaft, rendering_of(scan, voxels, shaft), voxels);
  if (!best) {
    return std::nullopt;
  }
  // An end that moves far was not seen, as where two tips touch: it stays where the search put it.
  for (const std::size_t end : {kTip, kRear}) {
    if (std::abs(best->parameters[end]) > 0.9 * kMostMoved_m) {
      best->parameters[end] = 0.0;
    }
  }
  Shaft out = limited(shaft, best->parameters);
  if ((out.line.middle_m - shaft.line.middle_m).norm() > kMostMoved_m ||
      angle_between_rad(out.line.direction, shaft.line.direction) > kMostRotation_rad) {
    return std::nullopt;
  }
  const auto count = static_cast<double>(voxels.size());
  out.misfit_hu = kNoise_hu * std::sqrt(best->sum_of_squares / count);
  out.covariance = axis_covariance(*best, voxels.size(), out.line.half_m);
  return out;
}

}  // namespace orthonav::engine
