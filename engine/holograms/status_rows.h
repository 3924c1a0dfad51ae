#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "engine/session/status_parts.h"

namespace orthonav::engine {

// How the words of the status line become rows that the narrowest display shows whole. Widths are
// in cap heights of the embedded font. Nothing here allocates where the strings have the room.

/// Of the rows: what both eyes see of a HoloLens 2 (43 degrees across, eyes up to 72 mm apart),
/// less one degree at either edge.
inline constexpr float kStatusWidth_caps = 68.0f;
/// Rows beside the one with the step and the tools.
inline constexpr std::size_t kDetailRows = 2;

/// Without rims.
[[nodiscard]] float width_caps(std::string_view text);

/// The text, or as much of it as fits with an ellipsis behind it.
void append_cut(std::string& out, std::string_view text, float width_caps);

/// Puts a text into as many of the rows as it takes, between words. What does not fit is left out
/// part by part, the least important first and of equals the last, and an ellipsis says so; a part
/// that does not fit alone is cut. Rows that are not needed are empty.
void fill_rows(std::string_view text, const StatusParts& parts, std::span<std::string*> rows);

}  // namespace orthonav::engine
