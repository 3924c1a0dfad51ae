#include "tools/preview/keys.h"

#include <algorithm>
#include <array>

namespace orthonav::preview {
namespace {

using enum Command;

constexpr auto kBindings = std::to_array<KeyBinding>({
    {Key::kSpace, "space", kClicker, "clicker: hold, tap, tap twice"},
    {key_of('s'), "s", kSay, "start"},
    {key_of('v'), "v", kSay, "save"},
    {key_of('d'), "d", kSay, "delete"},
    {key_of('a'), "a", kSay, "accept"},
    {key_of('r'), "r", kSay, "reject"},
    {key_of('n'), "n", kSay, "next"},
    {key_of('f'), "f", kSay, "done"},
    {key_of('m'), "m", kSay, "move rod"},
    {key_of('t'), "t", kSay, "twin"},
    {key_of('w'), "w", kSay, "numbers"},
    {key_of('y'), "y", kSay, "move cranial one"},
    {key_of('b'), "b", kSay, "move caudal one"},
    {key_of('g'), "g", kSay, "move medial one"},
    {key_of('j'), "j", kSay, "move lateral one"},
    {key_of(']'), "]", kSay, "longer"},
    {key_of('['), "[", kSay, "shorter"},
    {key_of('.'), ".", kSay, "thicker"},
    {key_of(','), ",", kSay, "thinner"},
    {key_of('z'), "z", kSay, "undo"},
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

const KeyBinding* find(const auto& fits) {
  const auto found = std::find_if(kBindings.begin(), kBindings.end(), fits);
  return found == kBindings.end() ? nullptr : &*found;
}

}  // namespace

std::span<const KeyBinding> key_bindings() { return kBindings; }

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
