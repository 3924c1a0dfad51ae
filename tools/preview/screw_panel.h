#pragma once

#include <functional>
#include <string>

namespace orthonav::preview {

/// Takes a phrase as if it had been said.
using SayPhrase = std::function<void(const std::string& phrase)>;

/// A button for each step of a change of the planned screw, and a line for any command. Made with
/// Dear ImGui.
void draw_screw(const SayPhrase& say);

}  // namespace orthonav::preview
