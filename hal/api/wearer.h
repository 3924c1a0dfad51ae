#pragma once

#include <cstdint>
#include <vector>

#include "base/time.h"
#include "base/transform.h"

namespace orthonav {

/// A frame for a simulated wearer: what is to be seen in it, as whoever simulates them writes and
/// reads it. Devices only pass it on.
struct WornFrame {
  Timestamp display_time{};
  /// To the wearer's World from the one that the frame was drawn in: they differ where a wrapper in
  /// between has moved the map.
  Transform<World, World> wearer_from_drawn;
  std::vector<std::uint8_t> content;
};

/// The simulated person behind a display, here or at the far end of a connection, who can't read
/// its pixels. Thread-safe.
class Wearer {
 public:
  virtual ~Wearer() = default;
  /// The frame lights up at its display time; one that is not later than those before is not seen.
  virtual void see(const WornFrame& frame) = 0;
};

}  // namespace orthonav
