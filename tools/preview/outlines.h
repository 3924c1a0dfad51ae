#pragma once

#include "render/scene.h"
#include "tools/preview/timeline.h"

namespace orthonav::preview {

/// Lines for tracked things: each tool from its tag to its tip and, when seen from outside, the
/// head with its field of view. They are not holograms and have labels of none.
void add_outlines(const Moment& moment, bool with_head, render::Scene& scene);

}  // namespace orthonav::preview
