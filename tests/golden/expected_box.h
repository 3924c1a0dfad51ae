#pragma once

#include <cstddef>

#include "engine/golden/golden_scenes.h"

namespace orthonav::engine {

/// Where something must lie in a view, continuous pixels.
struct Box {
  double left = 1e9;
  double right = -1e9;
  double top = 1e9;
  double bottom = -1e9;
};

/// The box of a hologram's surfaces, triangles and lines, projected on the CPU; texts left out.
[[nodiscard]] Box box_of_shapes(const GoldenScene& golden, render::Label label, std::size_t view);

/// The box of a text's ink as the CPU lays it out and projects it.
[[nodiscard]] Box box_of_text(const GoldenScene& golden, const render::TextItem& item,
                              std::size_t view);

}  // namespace orthonav::engine
