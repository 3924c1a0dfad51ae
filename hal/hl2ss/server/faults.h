#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "base/vec.h"

namespace orthonav::hl2ss {

/// Intentional faults: probabilities per pair, drawn from the seed.
struct Faults {
  double gap = 0.0;        ///< the pair is never sent
  double lose = 0.0;       ///< one of its two images is never sent
  double unlocated = 0.0;  ///< it is sent without a pose
  double stall = 0.0;      ///< nothing is sent for 0.3 s after it
  double half = 0.0;       ///< half a packet, a pause, the other half
  double cut = 0.0;        ///< half a packet, then the connection is closed
  double misstamp = 0.0;   ///< one of its images is stamped 0.1 s early or 1 s late
  double corrupt = 0.0;    ///< one of: NaN pose, size of 4 GiB, short image, stamp far off, noise
  // Per frame of the headset's scene in which there is something to do.
  double scene_stall = 0.0;   ///< it does nothing for a second
  double scene_refuse = 0.0;  ///< a command is refused
  double scene_cut = 0.0;     ///< its connection is closed
  /// World jumps by the amounts below at the pairs with these numbers.
  std::vector<std::int64_t> jump_at;
  Vec3 jump_m{0.3, 0.05, -0.2};
  double jump_rad = 0.4;  ///< about +y

  // From the pair with this number on, for `lasting` pairs or, if that is 0, to the end.
  std::optional<std::int64_t> freeze_pictures;  ///< both cameras repeat their pictures
  std::optional<std::int64_t> freeze_left;      ///< one of them does
  std::optional<std::int64_t> freeze_right;
  std::optional<std::int64_t> freeze_poses;  ///< every image is sent with the same pose
  /// The right camera's images are stamped a pair late, so that left and right are of different
  /// moments.
  std::optional<std::int64_t> shift_right;
  std::optional<std::int64_t> only_left;   ///< the right camera sends nothing
  std::optional<std::int64_t> clock_back;  ///< the headset's clock is set back, but no sensor's
  std::int64_t lasting = 0;
  Duration clock_back_by = std::chrono::milliseconds(500);

  /// Whether a fault from that pair on strikes the pair `number`.
  [[nodiscard]] bool strikes(std::optional<std::int64_t> from, std::int64_t number) const {
    return from && number >= *from && (lasting == 0 || number < *from + lasting);
  }

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// "gap=0.02,cut=0.005,jump=300,freeze_left=90,lasting=60", or "all" for a little of each of the
/// probable ones.
Result<Faults> faults_of(std::string_view text);

}  // namespace orthonav::hl2ss
