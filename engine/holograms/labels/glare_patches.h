#pragma once

#include <array>
#include <vector>

#include "engine/session/guidance.h"
#include "render/scene.h"

namespace orthonav::engine {

/// A flat patch of the world on which labels are unreadable, such as a printed tag: its corners in
/// order, metres.
using GlarePatch = std::array<render::Float3, 4>;

/// Replaces `patches` by the paper of the tracked tags.
void write_patches(const Guidance& guidance, std::vector<GlarePatch>& patches);

}  // namespace orthonav::engine
