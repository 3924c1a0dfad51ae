#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "engine/session/replan.h"

namespace orthonav::engine {

/// What a phrase asks to be changed of the screw in work; nothing where it does not begin as such a
/// phrase does. An Error in one line where it does, and the rest is missing or not understood:
/// nothing is guessed. Lengths are in mm and angles in degrees, said or not; typed numbers serve
/// as well as words.
///
///     screw six forty five       6 × 45 mm; "six five forty" and "six point five forty": 6.5 × 40
///     diameter six, length forty five, thicker, thinner, longer, shorter
///     move cranial one           the whole screw; also entry, target; caudal, medial, lateral
///     tilt medial two            about its entry
///     undo
[[nodiscard]] std::optional<Result<Replan>> replan_from(std::string_view phrase);

/// Those of them that a list of phrases can hold: one step each way, the next sizes, undo.
[[nodiscard]] std::vector<std::string> replan_phrases();

}  // namespace orthonav::engine
