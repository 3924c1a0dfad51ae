#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "engine/session/text/status_line.h"

namespace orthonav::engine {

// Breaks the status line into rows that fit the narrowest display. Widths are in cap heights of the
// embedded font. Nothing here allocates if the strings have room.

/// Width of the rows: what both eyes see in a HoloLens 2 (43 degrees across, eyes up to 72 mm
/// apart), minus one degree at either edge.
inline constexpr float kStatusWidth_caps = 68.0f;
/// Rows in addition to the one with the step and the tools.
inline constexpr std::size_t kDetailRows = 2;

/// Without rims.
[[nodiscard]] float width_caps(std::string_view text);

/// Appends the text, or as much of it as fits, with an ellipsis.
void append_cut(std::string& out, std::string_view text, float width_caps);

/// Breaks a text between words into as many of the rows as needed. If it does not fit, parts are
/// left out, the least important first and the last of equals, and an ellipsis shows it; a part
/// that does not fit alone is cut. Unused rows are empty.
void fill_rows(std::string_view text, const StatusParts& parts, std::span<std::string*> rows);

}  // namespace orthonav::engine
