#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/side.h"
#include "hal/sim/room.h"

namespace orthonav::sim {

struct Truth;

/// A wire as it stands in a bone.
struct StandingWire {
  Point<Vertebra> entry;
  Vec3 direction;  ///< unit, into the bone
};

/// A screw head as it stands in the room.
struct StandingHead {
  std::string_view level;
  Point<Room> position;
};

/// The metal that stands in the bones, which anyone can see and touch: all that a surgeon knows of
/// the truth.
class StandingMetal {
 public:
  /// The truth must outlive it.
  explicit StandingMetal(const Truth& truth) : truth_(&truth) {}
  /// The wire of a screw; nothing where there is none.
  [[nodiscard]] std::optional<StandingWire> wire(std::string_view level, Side side) const;
  [[nodiscard]] std::vector<StandingHead> heads(Side side) const;

 private:
  const Truth* truth_;
};

}  // namespace orthonav::sim
