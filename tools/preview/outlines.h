#pragma once

#include "render/scene.h"
#include "tools/preview/timeline.h"

namespace orthonav::preview {

/// Lines for what is tracked: each tool from its tag to its tip, and, as others see it, the head
/// with where it looks. Not holograms: their labels belong to none.
void add_outlines(const Moment& moment, bool with_head, render::Scene& scene);

}  // namespace orthonav::preview
