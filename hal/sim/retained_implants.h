#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/side.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

struct Truth;

/// A wire in a bone.
struct StandingWire {
  Point<Vertebra> entry;
  Vec3 direction;  ///< unit, into the bone
};

/// A screw head in the room.
struct StandingHead {
  std::string_view level;
  Point<Room> position;
};

/// The metal in the bones, which anyone can see and touch: the only part of the truth that the
/// surgeon knows.
class RetainedImplants {
 public:
  /// The truth must outlive it.
  explicit RetainedImplants(const Truth& truth) : truth_(&truth) {}
  /// The wire of a screw, if there is one.
  [[nodiscard]] std::optional<StandingWire> wire(std::string_view level, Side side) const;
  [[nodiscard]] std::vector<StandingHead> heads(Side side) const;

 private:
  const Truth* truth_;
};

}  // namespace orthonav::sim
