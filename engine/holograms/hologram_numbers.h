#pragma once

#include "engine/holograms/hologram_cross.h"
#include "engine/session/numbers_wording.h"
#include "render/scene.h"

namespace orthonav::engine {

/// H13: under the target cross, as a caption of its dots: where the tip is and where the tool aims,
/// a row each; numbers that are not sure in a paler white, with their SD. `registration_only`: such
/// an SD lacks what all strokes share, and a further row says so; it does too of the bound of a
/// clearance below, where there is one (`with_bound`).
void add_numbers(render::Scene& scene, const TargetCross& cross, const nav::ScrewNumbers& numbers,
                 bool registration_only, render::Label label, bool with_bound = false);
/// Two rows below them: the screw's clearance if it were driven along the tool, and its 95 % bound;
/// in a red rim that it may break through, and where to, in place of a bound below 0.
void add_clearance(render::Scene& scene, const TargetCross& cross,
                   const nav::ShownClearance& clearance, render::Label label);

/// On the row above the numbers, whether the surgeon drills and how it goes; an alarm in a rim of
/// its colour, a stop larger. Nothing where there is nothing to say.
void add_drill(render::Scene& scene, const TargetCross& cross, const nav::DrillView& drill,
               render::Label label);

}  // namespace orthonav::engine
