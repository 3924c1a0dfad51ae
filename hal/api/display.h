#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/time.h"
#include "base/transform.h"

namespace orthonav {

/// What a person wearing the display can read off one hologram: text and a few world positions.
struct ShownHologram {
  std::string name;  ///< as in docs: "H4 planned trajectory", "H5 triangle", "H6 angle", ...
  std::string text;  ///< what is written there, if anything
  std::vector<Point<World>> points_in_world;
};

/// One displayed frame as its wearer perceives it.
struct ShownFrame {
  Timestamp display_time{};
  Timestamp pose_time{};  ///< mid-exposure of the images that the newest pose came from
  std::vector<ShownHologram> holograms;
};

/// The see-through display. Pixels go to a swapchain or an image; what was shown is reported here,
/// so that a simulated wearer can read it. Contract: display times strictly increase; a frame that
/// breaks this is refused and reaches nobody.
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
