#pragma once

#include "engine/holograms/hologram_cross.h"
#include "engine/session/numbers_wording.h"
#include "render/scene.h"

namespace orthonav::engine {

/// H13: under the target cross, as a caption of its dots: where the tip is and where the tool aims,
/// a row each; numbers that are not sure in a paler white, with their SD. `registration_only`: such
/// an SD lacks what all strokes share, and a further row says so.
void add_numbers(render::Scene& scene, const TargetCross& cross, const nav::ScrewNumbers& numbers,
                 bool registration_only, render::Label label);

}  // namespace orthonav::engine
