#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace orthonav::preview {

/// A key of the keyboard: letters and digits by their character, lower case.
enum class Key : std::uint16_t {
  kSpace = ' ',
  kTab = 256,
  kEscape,
  kBackspace,
  kLeft,
  kRight,
  kF10,
  kF11,
  kF12,
};
[[nodiscard]] constexpr Key key_of(char c) { return static_cast<Key>(c); }

enum class Command : std::uint8_t {
  kClicker,
  kSay,
  kMute,
  kPause,
  kBack,
  kForward,
  kLive,
  kSlower,
  kFaster,
  kOrbit,
  kHologram,
  kAllHolograms,
  kTools,
  kScreenshot,
  kVideo,
  kPanel,
  kHelp,
  kRestart,
  kQuit,
};

/// A key and what it does. The help is made from this table, and nothing else knows it.
struct KeyBinding {
  Key key;
  std::string_view name;  ///< as written on the key, and in scripts
  Command command;
  std::string_view what;  ///< for the help; of a phrase: the phrase
  unsigned hologram = 0;  ///< of kHologram: its number
};

[[nodiscard]] std::span<const KeyBinding> key_bindings();
[[nodiscard]] const KeyBinding* binding_of(Key key);
[[nodiscard]] std::optional<Key> key_named(std::string_view name);

}  // namespace orthonav::preview
