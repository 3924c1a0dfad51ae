#pragma once

#include <array>
#include <vector>

#include "engine/session/guidance.h"
#include "render/scene.h"

namespace orthonav::engine {

/// A flat patch of the world on which no label can be read, such as a printed tag: its corners in
/// order, metres.
using GlarePatch = std::array<render::Float3, 4>;

/// The paper of the tags that are tracked, in place of what `patches` held.
void write_patches(const Guidance& guidance, std::vector<GlarePatch>& patches);

}  // namespace orthonav::engine
