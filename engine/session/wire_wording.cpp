#include "engine/session/wire_wording.h"

#include "base/angle.h"
#include "base/printed.h"
#include "engine/session/wording.h"

namespace orthonav::engine {

void append_wire(std::string& out, const PlacedWire& wire) {
  const nav::PlacedAxis& axis = wire.axis;
  append_printed(out, "%.1f ± %.1f°, %.1f ± %.1f mm", degrees(axis.angle_rad.value),
                 degrees(axis.angle_rad.sd), axis.entry_m.value * 1e3, axis.entry_m.sd * 1e3);
}

void write_wire(PartedText text, const WireSoFar& state, std::string_view separator) {
  std::string& out = text.out;
  if (state.wire == nullptr) {
    text.begin(Importance::kNext, separator);
    out += "set the sleeve over the wire, turn it and click, or say next";
    return;
  }
  const PlacedWire& wire = *state.wire;
  text.begin(Importance::kMessage, separator);
  out += "placed: ";
  append_wire(out, wire);
  out += " from the plan";
  if (wire.within()) {
    return;
  }
  text.begin(wire.kept ? Importance::kMessage : Importance::kDanger, "; ");
  if (!wire.angle_within()) {
    append_beside_limit(out, "angle %.1f°, limit %.1f°", degrees(wire.axis.angle_rad.value),
                        degrees(wire.angle_limit_rad));
  }
  if (!wire.entry_within()) {
    out += wire.angle_within() ? "" : "; ";
    append_beside_limit(out, "entry %.1f mm, limit %.1f mm", wire.axis.entry_m.value * 1e3,
                        wire.entry_limit_m * 1e3);
  }
  text.begin(Importance::kNext, ": ");
  if (wire.kept) {
    out += "kept, say next";
  } else {
    out += state.no_other_entry ? words::kNoOtherEntry : words::kKeepOrRedo;
  }
}

}  // namespace orthonav::engine
