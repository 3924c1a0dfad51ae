#include "hal/sim/retained_implants.h"

#include "hal/sim/truth.h"

namespace orthonav::sim {

std::optional<StandingWire> RetainedImplants::wire(std::string_view level, Side side) const {
  for (const DrivenWire& wire : truth_->wires) {
    if (wire.level == level && wire.side == side) {
      return StandingWire{wire.entry, wire.direction};
    }
  }
  return std::nullopt;
}

std::vector<StandingHead> RetainedImplants::heads(Side side) const {
  std::vector<StandingHead> found;
  for (const PlacedHead& head : truth_->heads) {
    if (head.side == side) {
      found.push_back({head.level, head.position});
    }
  }
  return found;
}

}  // namespace orthonav::sim
