#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/side.h"
#include "base/time.h"
#include "base/transform.h"
#include "hal/api/shown_status.h"

namespace orthonav {

/// The holograms by their numbers in docs/holograms.md: H1 to H13.
enum class HologramKind : std::uint8_t {
  kPath = 1,
  kVertebra,
  kEntry,
  kTrajectory,
  kTriangle,
  kAngle,
  kCross,
  kTwin,
  kDepth,
  kRod,
  kStatus,
  kCheckPoint,
  kNumbers,
};

/// What a person wearing the display can read off one hologram: text and a few world positions.
struct ShownHologram {
  HologramKind kind = HologramKind::kPath;
  std::string level;         ///< of an entry point: the vertebra's label
  std::optional<Side> side;  ///< of an entry point, or of the screw that the numbers concern
  std::string text;          ///< what is written there, if anything
  /// The number shown: the angle (rad) or the tip's offset (m) as displayed, or the distance of a
  /// check point (m). Absent on a place still to be touched, and where dashes or a bound are shown.
  std::optional<double> reading;
  std::vector<Point<World>> points_in_world;
};

/// One displayed frame as its wearer perceives it.
struct ShownFrame {
  Timestamp display_time{};
  Timestamp pose_time{};              ///< mid-exposure of the images of the newest pose
  std::optional<ShownStatus> status;  ///< absent: no status line
  std::vector<ShownHologram> holograms;
};

/// The see-through display. Pixels go to a swapchain or an image; the content shown is reported
/// here, so that a simulated wearer can read it. Contract: display times strictly increase; a frame
/// that breaks this is refused and not passed on.
class Display {
 public:
  virtual ~Display() = default;
  /// When a frame submitted now will light up.
  [[nodiscard]] Timestamp predicted_display_time(Timestamp now) const { return now + do_latency(); }
  Status shown(const ShownFrame& frame);

 private:
  [[nodiscard]] virtual Duration do_latency() const = 0;
  virtual Status do_shown(const ShownFrame& frame) = 0;

  Timestamp last_display_time_ = Timestamp::min();
};

}  // namespace orthonav
