#pragma once

#include <span>
#include <string_view>

#include "engine/session/status_parts.h"
#include "render/scene.h"

namespace orthonav::engine {

// H11, low in view wherever the head goes. No more than the narrowest display shows
// (engine/holograms/status_rows.h).

enum class ToolState { kMeasured, kPredicted, kLost };
struct ToolDot {
  std::string_view name;
  ToolState state = ToolState::kLost;
};

/// H13: above all rows, in a red rim, seen wherever the head looks.
void add_stop_row(render::Scene& scene, std::string_view text, render::Label label);
/// A row above the one with the step, as white as that.
void add_row_above_status(render::Scene& scene, std::string_view text, render::Label label);

/// What the status line says.
struct StatusWords {
  std::string_view step;
  std::string_view detail;             ///< beside the step
  const StatusParts* parts = nullptr;  ///< of the detail; null: it is one part
};

/// H11: what everything else depends on, above the status line.
void add_notice(render::Scene& scene, std::string_view text, render::Label label);

/// H11: a row with the step and a dot for each tool, filled where it is measured, half where
/// predicted, empty where lost; below it the detail, on two rows at most. Step and dots always
/// show: where there is no room, names of tools give way first, of a long step its end.
void add_status_line(render::Scene& scene, const StatusWords& words, std::span<const ToolDot> tools,
                     render::Label label);

/// The same of a line that is written already: what comes before the first " | " is the step.
void add_status_line(render::Scene& scene, std::string_view text, std::span<const ToolDot> tools,
                     render::Label label);

}  // namespace orthonav::engine
