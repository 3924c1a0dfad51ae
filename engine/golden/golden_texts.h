#pragma once

#include <string>
#include <vector>

#include "render/scene.h"

namespace orthonav::engine {

/// A kind of text, drawn by its hologram.
struct TextKind {
  std::string name;
  render::TextItem text;
};

/// Every kind of text that a surgeon reads in the display, in a fixed order.
[[nodiscard]] std::vector<TextKind> text_kinds();

}  // namespace orthonav::engine
