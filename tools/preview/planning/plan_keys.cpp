#include "tools/preview/planning/plan_keys.h"

#include <algorithm>
#include <array>
#include <vector>

#include "engine/session/workflow/commands.h"

namespace orthonav::preview {
namespace {

using enum PlanCommand;

constexpr auto kOwn = std::to_array<PlanKeyBinding>({
    {Key::kRight, "right", kNext, "next screw"},
    {Key::kLeft, "left", kBefore, "the screw before"},
    {key_of('a'), "a", kSay, "auto"},
    {key_of('d'), "d", kSay, "delete"},
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

/// A change of the screw has the same key as during an operation.
std::vector<PlanKeyBinding> every_binding() {
  std::vector<PlanKeyBinding> all(kOwn.begin(), kOwn.end());
  for (const engine::Command& command : engine::kCommands) {
    if (command.event == engine::Event::kSayReplan && command.key != '\0') {
      all.push_back({key_of(command.key), {&command.key, 1}, kSay, command.name});
    }
  }
  return all;
}

}  // namespace

std::span<const PlanKeyBinding> plan_key_bindings() {
  static const std::vector<PlanKeyBinding> kBindings = every_binding();
  return kBindings;
}

const PlanKeyBinding* plan_binding_of(Key key) {
  const std::span<const PlanKeyBinding> bindings = plan_key_bindings();
  const auto found =
      std::find_if(bindings.begin(), bindings.end(),
                   [key](const PlanKeyBinding& binding) { return binding.key == key; });
  return found == bindings.end() ? nullptr : &*found;
}

}  // namespace orthonav::preview
