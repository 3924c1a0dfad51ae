#pragma once

#include <string>

#include "engine/io/json_document.h"
#include "render/scene.h"

namespace orthonav::engine {

/// Adds the hologram that a node of a scene file describes; problems are noted in its document.
/// `folder` is the folder of its mesh files; `label` is that of the k-th hologram of its kind.
void add_hologram(const JsonNode& node, const std::string& folder, std::size_t k,
                  render::Scene& scene);

/// The number n of hologram Hn of a kind ("path": 1); 99 for `line` and `text`; 0: unknown.
[[nodiscard]] render::Label hologram_number(const std::string& type);

}  // namespace orthonav::engine
