#pragma once

#include <string>

#include "engine/session/session_record.h"

namespace orthonav::engine {

/// "0.8 ± 0.4°, 0.6 ± 0.3 mm, kept; redone once": how the wire was measured where it stood.
[[nodiscard]] std::string wire_text(const RecordedScrew& screw);
/// What was found of the guide: its tip in one dimple with the pointer's, its axis on a wire.
/// A list of HTML.
[[nodiscard]] std::string guide_notes(const SessionRecord& session);

}  // namespace orthonav::engine
