#pragma once

#include <vector>

#include "render/scene.h"

namespace orthonav::bench {

/// A full frame of guidance: a vertebra of 32k triangles, a path of 2000 samples, the rod with its
/// heads, trajectory, deviation triangle, target cross, entry points, readout and status line.
struct FullScene {
  render::Scene scene;
  std::vector<render::View> views;  ///< both eyes
};
[[nodiscard]] FullScene full_scene();

/// The same views with the head swayed a little, differently in every frame.
[[nodiscard]] std::vector<render::View> swayed(const std::vector<render::View>& views, int frame);

}  // namespace orthonav::bench
