#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "engine/session/replan.h"

namespace orthonav::engine {

/// The change of the current screw that a phrase asks for; nothing if it does not begin like such a
/// phrase. A one-line Error if it does, but the rest is missing or not understood: nothing is
/// guessed. Lengths are in mm and angles in degrees, whether said or not; typed numbers work like
/// words.
///
///     screw six forty five       6 × 45 mm; "six five forty" and "six point five forty": 6.5 × 40
///     diameter six, length forty five, thicker, thinner, longer, shorter
///     move cranial one           the whole screw; also entry, target; caudal, medial, lateral
///     tilt medial two            about its entry
///     undo
[[nodiscard]] std::optional<Result<Replan>> replan_from(std::string_view phrase);

/// The phrases that fit in a finite list: one step in each direction, the next sizes, undo.
[[nodiscard]] std::vector<std::string> replan_phrases();

}  // namespace orthonav::engine
