#include "tools/preview/screw_panel.h"

#include <imgui.h>

#include <array>
#include <string>

namespace orthonav::preview {
namespace {

constexpr std::array<const char*, 4> kWays = {"cranial", "caudal", "medial", "lateral"};

void say_button(const SayPhrase& say, const std::string& shown, const std::string& phrase) {
  ImGui::PushID(phrase.c_str());
  if (ImGui::Button(shown.c_str())) {
    say(phrase);
  }
  ImGui::PopID();
}

/// "move 1 mm" and a button for each direction.
void row_of_ways(const SayPhrase& say, const char* title, const std::string& verb) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(title);
  for (std::size_t i = 0; i < kWays.size(); ++i) {
    ImGui::SameLine(i == 0 ? 90.0f : 0.0f, i == 0 ? -1.0f : 4.0f);
    say_button(say, kWays[i], verb + " " + kWays[i] + " one");
  }
}

}  // namespace

void draw_screw(const SayPhrase& say) {
  row_of_ways(say, "move 1 mm", "move");
  row_of_ways(say, "tilt 1\u00b0", "tilt");
  for (const char* word : {"longer", "shorter", "thicker", "thinner", "undo"}) {
    say_button(say, word, word);
    ImGui::SameLine(0.0f, 4.0f);
  }
  ImGui::NewLine();
  static constexpr std::size_t kMostLetters = 80;
  std::array<char, kMostLetters> line{};
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::InputTextWithHint("##say", "say: screw six forty five", line.data(), line.size(),
                               ImGuiInputTextFlags_EnterReturnsTrue)) {
    say(line.data());
  }
}

}  // namespace orthonav::preview
