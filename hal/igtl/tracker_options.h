#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/angle.h"
#include "base/result.h"
#include "base/time.h"
#include "hal/igtl/pose_frames.h"

namespace orthonav::igtl {

inline constexpr int kUsualPort = 18944;

/// Options for a program that tracks tools and sends their poses.
struct TrackerOptions {
  std::string host;
  int port = kUsualPort;
  std::vector<NamedTransform> tools;
  /// RMS error of its poses in 3-D, from the configuration, since the protocol can't state it. The
  /// defaults are larger than an optical tracker's.
  double rms_m = 0.0005;
  double rms_rad = 0.5 * kRadiansPerDegree;
  Duration frozen_after = PoseFramesOptions{}.frozen_after;
  /// The longest wait for the first pose when opening.
  Duration open_within = std::chrono::seconds(8);

  /// Covariance of a pose: the same along (about) each axis.
  [[nodiscard]] PoseCovariance covariance() const;
};

/// What follows `igtl:` in a URI:
/// `//HOST[:PORT]?TOOL=TRANSFORM&...[&port=N&rms_mm=N&rms_deg=N&frozen_ms=N]`. An Error says what
/// is wrong with it.
Result<TrackerOptions> tracker_options_of(std::string_view after_scheme);

}  // namespace orthonav::igtl
