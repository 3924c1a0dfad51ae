#include "engine/session/wire_wording.h"

#include "base/angle.h"
#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/said.h"
#include "engine/session/wording.h"

namespace orthonav::engine {

void append_wire(std::string& out, const PlacedWire& wire) {
  const nav::PlacedAxis& axis = wire.axis;
  append_printed(out, "%.1f°, %.1f mm", degrees(axis.angle_rad.value), axis.entry_m.value * 1e3);
}

void write_wire(PartedText text, const WireSoFar& state, std::string_view separator) {
  std::string& out = text.out;
  if (state.wire == nullptr) {
    text.begin(Importance::kNext, separator);
    out += translated("set the sleeve over the wire, turn it and click, or say go to next");
    return;
  }
  const PlacedWire& wire = *state.wire;
  if (wire.within()) {
    text.begin(Importance::kNext, separator);
    out += translated("within limits: say go to next");
    return;
  }
  text.begin(wire.kept ? Importance::kMessage : Importance::kDanger, separator);
  if (!wire.angle_within()) {
    append_beside_limit(out, translated("angle %.1f°, limit %.1f°"),
                        degrees(wire.axis.angle_rad.value), degrees(wire.angle_limit_rad));
  }
  if (!wire.entry_within()) {
    out += wire.angle_within() ? "" : "; ";
    append_beside_limit(out, translated("entry %.1f mm, limit %.1f mm"),
                        wire.axis.entry_m.value * 1e3, wire.entry_limit_m * 1e3);
  }
  text.begin(Importance::kNext, ": ");
  if (wire.kept) {
    out += translated("kept, say go to next");
  } else {
    out += translated(state.no_other_entry ? words::kNoOtherEntry : words::kKeepOrRedo);
  }
}

}  // namespace orthonav::engine
