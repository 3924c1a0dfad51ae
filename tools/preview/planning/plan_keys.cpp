#include "tools/preview/planning/plan_keys.h"

#include <algorithm>
#include <array>

namespace orthonav::preview {
namespace {

using enum PlanCommand;

/// A change has the same key as during an operation.
constexpr auto kBindings = std::to_array<PlanKeyBinding>({
    {Key::kRight, "right", kNext, "next screw"},
    {Key::kLeft, "left", kBefore, "the screw before"},
    {key_of('y'), "y", kSay, "move cranial one"},
    {key_of('b'), "b", kSay, "move caudal one"},
    {key_of('g'), "g", kSay, "move medial one"},
    {key_of('j'), "j", kSay, "move lateral one"},
    {key_of(']'), "]", kSay, "longer"},
    {key_of('['), "[", kSay, "shorter"},
    {key_of('.'), ".", kSay, "thicker"},
    {key_of(','), ",", kSay, "thinner"},
    {key_of('a'), "a", kSay, "auto"},
    {key_of('d'), "d", kSay, "delete"},
    {key_of('z'), "z", kSay, "undo"},
    {key_of('r'), "r", kSay, "redo"},
    {key_of('v'), "v", kSave, "save the plan as a new case"},
    {key_of('o'), "o", kViews, "all pictures as at first"},
    {key_of('i'), "i", kScreenshot, "screenshot of the window"},
    {Key::kTab, "tab", kPanel, "panel"},
    {key_of('h'), "h", kHelp, "this help"},
    {key_of('q'), "q", kQuit, "save and quit"},
    {Key::kEscape, "escape", kQuit, "save and quit"},
    {key_of('x'), "x", kDiscard, "quit without saving, pressed twice"},
});

}  // namespace

std::span<const PlanKeyBinding> plan_key_bindings() { return kBindings; }

const PlanKeyBinding* plan_binding_of(Key key) {
  const auto found =
      std::find_if(kBindings.begin(), kBindings.end(),
                   [key](const PlanKeyBinding& binding) { return binding.key == key; });
  return found == kBindings.end() ? nullptr : &*found;
}

}  // namespace orthonav::preview
