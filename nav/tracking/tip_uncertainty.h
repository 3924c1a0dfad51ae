#pragma once

#include <cstddef>
#include <span>

#include "base/transform.h"
#include "nav/tracking/pivot_fit.h"

namespace orthonav::nav {

/// How well the tip of a pivot fit is known.
struct TipUncertainty {
  Mat3 covariance_m2{};  ///< of the tip, in the marker's axes
  /// So many uncorrelated poses would locate the pivot as well.
  double independent_poses = 0.0;

  [[nodiscard]] double sigma_m() const;  ///< 3-D SD
};

/// The covariance of the least-squares tip from residuals that are correlated over time: the tip
/// wanders in its seat, and the tracker's error changes only as the tool turns. They are taken for
/// a first-order autoregressive process plus white noise, the same in each direction. Correlation
/// time and share of white noise are those of greatest restricted likelihood (Patterson & Thompson
/// 1971), at most an eighth of the poses: a longer time cannot be told from so many. The poses with
/// the indices `chosen`, rising, are those of `fit`. A shift of the seat that follows the tool's
/// lean is a different tip and cannot be seen.
[[nodiscard]] TipUncertainty tip_uncertainty(std::span<const Transform<World, Marker>> poses,
                                             std::span<const std::size_t> chosen,
                                             const PivotFit& fit);

}  // namespace orthonav::nav
