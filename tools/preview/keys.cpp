#include "tools/preview/keys.h"

#include <algorithm>
#include <array>
#include <vector>

#include "engine/session/workflow/commands.h"

namespace orthonav::preview {
namespace {

using enum Command;

constexpr KeyBinding kSpaceBar = {Key::kSpace, "space", kClicker, "clicker: hold, tap, tap twice"};
constexpr auto kOthers = std::to_array<KeyBinding>({
    {key_of('u'), "u", kMute, "mute the headset's own clicker and voice"},
    {key_of('p'), "p", kPause, "pause, go on"},
    {Key::kLeft, "left", kBack, "one pair back"},
    {Key::kRight, "right", kForward, "one pair on"},
    {key_of('l'), "l", kLive, "back to the newest pair"},
    {key_of('-'), "-", kSlower, "slower"},
    {key_of('='), "=", kFaster, "faster"},
    {key_of('o'), "o", kOrbit, "orbit, or through the surgeon's eye"},
    {key_of('1'), "1", kHologram, "", 1},
    {key_of('2'), "2", kHologram, "", 2},
    {key_of('3'), "3", kHologram, "", 3},
    {key_of('4'), "4", kHologram, "", 4},
    {key_of('5'), "5", kHologram, "", 5},
    {key_of('6'), "6", kHologram, "", 6},
    {key_of('7'), "7", kHologram, "", 7},
    {key_of('8'), "8", kHologram, "", 8},
    {key_of('9'), "9", kHologram, "", 9},
    {Key::kF10, "f10", kHologram, "", 10},
    {Key::kF11, "f11", kHologram, "", 11},
    {Key::kF12, "f12", kHologram, "", 12},
    {key_of('0'), "0", kAllHolograms, "all holograms, or none"},
    {key_of('x'), "x", kTools, "tools where they are tracked, as lines"},
    {key_of('i'), "i", kScreenshot, "screenshot of the window"},
    {key_of('k'), "k", kVideo, "record a video, stop"},
    {Key::kTab, "tab", kPanel, "panel"},
    {key_of('h'), "h", kHelp, "this help"},
    {Key::kBackspace, "backspace", kRestart, "start again, with the error sources as set"},
    {key_of('q'), "q", kQuit, "quit"},
    {Key::kEscape, "escape", kQuit, "quit"},
});

/// The clicker, the keys of the session's commands, and the window's own.
std::vector<KeyBinding> every_binding() {
  std::vector<KeyBinding> all = {kSpaceBar};
  for (const engine::Command& command : engine::kCommands) {
    if (command.key != '\0') {
      all.push_back({key_of(command.key), {&command.key, 1}, kSay, command.name});
    }
  }
  all.insert(all.end(), kOthers.begin(), kOthers.end());
  return all;
}

const KeyBinding* find(const auto& fits) {
  const std::span<const KeyBinding> bindings = key_bindings();
  const auto found = std::find_if(bindings.begin(), bindings.end(), fits);
  return found == bindings.end() ? nullptr : &*found;
}

}  // namespace

std::span<const KeyBinding> key_bindings() {
  static const std::vector<KeyBinding> kBindings = every_binding();
  return kBindings;
}

const KeyBinding* binding_of(Key key) {
  return find([key](const KeyBinding& binding) { return binding.key == key; });
}

std::optional<Key> key_named(std::string_view name) {
  const KeyBinding* binding = find([name](const KeyBinding& b) { return b.name == name; });
  if (!binding) {
    return std::nullopt;
  }
  return binding->key;
}

}  // namespace orthonav::preview
