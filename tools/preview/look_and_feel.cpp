#include "tools/preview/look_and_feel.h"

#include <imgui.h>

#include <filesystem>

namespace orthonav::preview {
namespace {

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float kFont_px = 15.0f;
/// Latin, Greek, and the few signs of units: superscripts, roots, arrows.
constexpr ImWchar kGlyphs[] = {0x20,   0xff,   0x370,  0x3ff,  0x2010, 0x2027, 0x2190,
                               0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};

}  // namespace

void set_look_and_feel() {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0.0f;
  style.FrameRounding = 3.0f;
  style.WindowBorderSize = 0.0f;
  style.ItemSpacing = {8.0f, 5.0f};
  style.Colors[ImGuiCol_WindowBg] = {0.09f, 0.10f, 0.12f, 1.0f};
  style.Colors[ImGuiCol_FrameBg] = {0.19f, 0.21f, 0.25f, 1.0f};
  style.Colors[ImGuiCol_CheckMark] = {0.55f, 0.85f, 0.60f, 1.0f};
  std::error_code code;
  if (std::filesystem::exists(kFont, code)) {
    ImGui::GetIO().Fonts->AddFontFromFileTTF(kFont, kFont_px, nullptr, kGlyphs);
  }
}

}  // namespace orthonav::preview
