#pragma once

#include <span>
#include <string_view>

#include "engine/session/text/status_line.h"
#include "render/scene.h"

namespace orthonav::engine {

// H11, low in view and fixed to the head. Limited to what the narrowest display can show
// (engine/holograms/labels/status_rows.h).

/// Where its anchor hangs in the head's frame, 11° below straight ahead, and how large its capitals
/// are.
inline constexpr render::Float3 kStatusPlace = {0, -0.096f, -0.5f};
inline constexpr float kStatusHeight_m = 0.003f;
inline constexpr float kStatusMinHeight_deg = 0.5f;

enum class ToolState { kMeasured, kPredicted, kLost };
struct ToolDot {
  ToolState state = ToolState::kLost;
};

/// H13: above all rows, in a red rim, visible in any direction of the head.
void add_stop_row(render::Scene& scene, std::string_view text, render::Label label);
/// So many rows below the one with the step: what to do next.
void add_next_act(render::Scene& scene, std::string_view text, std::size_t row,
                  render::Label label);

/// The content of the status line.
struct StatusWords {
  std::string_view step;
  std::string_view detail;             ///< beside the step
  const StatusParts* parts = nullptr;  ///< of the detail; null: it is one part
};

/// H11: a notice on which everything else depends, above the status line.
void add_notice(render::Scene& scene, std::string_view text, render::Label label);

/// H11: a row with the step and a dot for each tool, filled where it is measured, half where
/// predicted, empty where lost; below it the detail, on two rows at most. Step and dots are always
/// shown; of a long step the end is cut.
void add_status_line(render::Scene& scene, const StatusWords& words, std::span<const ToolDot> tools,
                     render::Label label);

/// The same for an already written line: the part before the first " | " is the step.
void add_status_line(render::Scene& scene, std::string_view text, std::span<const ToolDot> tools,
                     render::Label label);

}  // namespace orthonav::engine
