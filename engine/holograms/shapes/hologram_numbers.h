#pragma once

#include "engine/holograms/shapes/hologram_cross.h"
#include "engine/session/steps/guiding.h"
#include "render/scene.h"

namespace orthonav::engine {

/// H13, where it was asked for: below the rows under the target cross, one row for the position of
/// the tip and one for the tool's aim; numbers that are not sure in a paler white, with their SD.
/// `registration_only`: such an SD does not include common errors of all strokes, and a further row
/// says so; it also refers to the bound of a clearance below, if there is one (`with_bound`).
void add_numbers(render::Scene& scene, const TargetCross& cross, const nav::ScrewNumbers& numbers,
                 bool registration_only, render::Label label, bool with_bound = false);
/// Two rows below them: the screw's clearance if it were driven along the tool, and its 95 % bound;
/// if the bound is below 0, instead of it, in a red rim, that the screw may break through and
/// where.
void add_clearance(render::Scene& scene, const TargetCross& cross,
                   const nav::ShownClearance& clearance, render::Label label);

}  // namespace orthonav::engine
