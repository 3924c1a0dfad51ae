#pragma once

#include <algorithm>
#include <cstddef>

#include "engine/session/shown_frame.h"
#include "render/scene.h"

namespace orthonav::engine {

// An item's label identifies its hologram: 100·n + k for the k-th instance of Hn (render/scene.h).

inline constexpr render::Label kInstancesOfAKind = 100;
/// Instances beyond this one share its label.
inline constexpr std::size_t kMaxInstances = kInstancesOfAKind - 1;

[[nodiscard]] constexpr render::Label label_of(HologramKind kind, std::size_t instance) {
  return kInstancesOfAKind * static_cast<render::Label>(kind) +
         static_cast<render::Label>(std::min(instance, kMaxInstances));
}
/// The label must be a hologram's.
[[nodiscard]] constexpr HologramKind kind_of(render::Label label) {
  return static_cast<HologramKind>(label / kInstancesOfAKind);
}
[[nodiscard]] constexpr std::size_t instance_of(render::Label label) {
  return label % kInstancesOfAKind;
}

}  // namespace orthonav::engine
