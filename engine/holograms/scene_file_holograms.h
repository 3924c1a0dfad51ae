#pragma once

#include <string>

#include "engine/io/json_document.h"
#include "render/scene.h"

namespace orthonav::engine {

/// Adds the hologram that a node of a scene file tells of; problems are noted in its document.
/// `folder` is where its mesh files lie; `label` is of the k-th hologram of its kind.
void add_hologram(const JsonNode& node, const std::string& folder, std::size_t k,
                  render::Scene& scene);

/// The number n of hologram Hn of a kind ("path": 1); 99 for `line` and `text`; 0: not known.
[[nodiscard]] render::Label hologram_number(const std::string& type);

/// A number between limits, which its refusal names.
[[nodiscard]] double number_between(const JsonNode& node, const char* key, double low, double high,
                                    const char* unit);
/// A length in millimetres between limits, in metres.
[[nodiscard]] float length_from(const JsonNode& node, const char* key, double low_mm,
                                double high_mm);
[[nodiscard]] render::Float3 place_from(const JsonNode& node, const char* key);

}  // namespace orthonav::engine
