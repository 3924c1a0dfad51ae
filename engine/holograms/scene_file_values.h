#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "engine/holograms/shapes/hologram_shapes.h"
#include "engine/io/json_document.h"
#include "render/scene.h"

namespace orthonav::engine {

// Reads values from a node of a scene file; problems are noted in its document.

/// Limit of every coordinate and distance.
inline constexpr double kFarthest_mm = 10'000.0;

/// A number between limits, which an error message names.
[[nodiscard]] double number_between(const JsonNode& node, const char* key, double low, double high,
                                    const char* unit);
/// A length in millimetres between limits, in metres.
[[nodiscard]] float length_from(const JsonNode& node, const char* key, double low_mm,
                                double high_mm);
[[nodiscard]] render::Float3 place_from(const JsonNode& node, const char* key);
/// Places in millimetres, in metres.
[[nodiscard]] std::vector<render::Float3> places_from(const JsonNode& node, const char* key);
/// Of unit length.
[[nodiscard]] render::Float3 direction_from(const JsonNode& node, const char* key);
/// The index of one of the words; the first if the key is absent.
[[nodiscard]] std::size_t word_from(const JsonNode& node, const char* key,
                                    std::span<const char* const> words);
/// `angle_deg`, if present.
[[nodiscard]] std::optional<double> angle_from(const JsonNode& node);
/// The grade of that angle; poor if it is absent.
[[nodiscard]] Grade grade_from(const JsonNode& node);
/// `colour`, linear; white if absent.
[[nodiscard]] render::Colour colour_from(const JsonNode& node);

}  // namespace orthonav::engine
