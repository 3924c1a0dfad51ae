#include "tools/preview/panel_parts.h"

#include <algorithm>

namespace orthonav::preview {

void text(const std::string& line) { ImGui::TextUnformatted(line.c_str()); }

void wrapped_text(const ImVec4& colour, const std::string& line) {
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextColored(colour, "%s", line.c_str());
  ImGui::PopTextWrapPos();
}

void help_line(const std::string& key, const std::string& what) {
  text(key);
  ImGui::SameLine(140.0f);
  text(what);
}

void draw_help_window(const std::function<void()>& lines) {
  ImGui::SetNextWindowPos({12.0f, 12.0f}, ImGuiCond_Appearing);
  ImGui::SetNextWindowBgAlpha(0.88f);
  constexpr auto kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize |
                          ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
  ImGui::Begin("help", nullptr, kFlags);
  lines();
  ImGui::End();
}

void draw_panel_window(const std::function<void()>& content) {
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  const float width = std::min(static_cast<float>(kPanel_px), room.x);
  ImGui::SetNextWindowPos({room.x - width, 0.0f});
  ImGui::SetNextWindowSize({width, room.y});
  constexpr auto kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                          ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav;
  ImGui::Begin("panel", nullptr, kFlags);
  // Tab is one of our keys; Dear ImGui would use it to go from slider to slider.
  ImGui::PushAllowKeyboardFocus(false);
  content();
  ImGui::PopAllowKeyboardFocus();
  ImGui::End();
}

}  // namespace orthonav::preview
