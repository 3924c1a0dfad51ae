#pragma once

#include <imgui.h>

#include <functional>
#include <string>

namespace orthonav::preview {

// Parts of every panel, made with Dear ImGui during a frame of the window.

inline const ImVec4 kGood{0.45f, 0.85f, 0.50f, 1.0f};
inline const ImVec4 kFair{0.95f, 0.75f, 0.25f, 1.0f};
inline const ImVec4 kBad{0.95f, 0.40f, 0.35f, 1.0f};
inline const ImVec4 kDim{0.60f, 0.63f, 0.68f, 1.0f};

inline constexpr int kPanel_px = 380;

void text(const std::string& line);
/// Over several lines where the panel is too narrow.
void wrapped_text(const ImVec4& colour, const std::string& line);
/// A line of the help.
void help_line(const std::string& key, const std::string& what);
/// The help, over the upper left of the picture.
void draw_help_window(const std::function<void()>& lines);
/// The panel at the right border.
void draw_panel_window(const std::function<void()>& content);

}  // namespace orthonav::preview
