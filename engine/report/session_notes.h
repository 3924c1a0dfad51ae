#pragma once

#include <string>

#include "engine/session/session_record.h"

namespace orthonav::engine {

/// "0.8 ± 0.4°, 0.6 ± 0.3 mm, kept; redone once": the measurement of the placed wire.
[[nodiscard]] std::string wire_text(const RecordedScrew& screw);
/// What was measured of the guide: its tip in the same dimple as the pointer's, its axis on a wire.
/// An HTML list.
[[nodiscard]] std::string guide_notes(const SessionRecord& session);

}  // namespace orthonav::engine
