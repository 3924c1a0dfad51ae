#pragma once

#include <memory>

#include "render/scene.h"

namespace orthonav::engine {

/// A made-up lumbar vertebra for pictures: smooth union of body, pedicles, laminae, facets and
/// processes. LPS axes (+x left, +y posterior, +z superior), metres. Not for measuring: the phantom
/// with published morphometry is a separate model and may change; this one must not, since golden
/// images show it.
[[nodiscard]] std::shared_ptr<const render::MeshData> make_golden_vertebra();

}  // namespace orthonav::engine
