#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/time.h"

namespace orthonav::desktop {

/// A key of a device went down or up.
struct KeyEvent {
  int code = 0;  ///< as in linux/input-event-codes.h
  bool down = false;
  Duration at{};  ///< by CLOCK_MONOTONIC, or since the first event of a file
  friend bool operator==(const KeyEvent&, const KeyEvent&) = default;
};

/// Where the key events come from.
class KeyEvents {
 public:
  virtual ~KeyEvents() = default;
  /// Appends the events since the last call, up to a limit; does not block. Errors: kLost, the
  /// source is gone for good; kUnavailable, nothing comes from it now; others refuse an event.
  virtual Status read(std::vector<KeyEvent>& events) = 0;
  /// Whether its times are those of CLOCK_MONOTONIC; otherwise they count from a file's first
  /// event.
  [[nodiscard]] virtual bool live() const = 0;
  [[nodiscard]] virtual std::string name() const = 0;
};

/// Which keys make up a button, and whether the device is grabbed from other programs.
struct KeyChoice {
  std::vector<int> codes;
  bool grab = true;
};

/// What presenters, camera remotes and foot pedals send: volume up and down, enter, page up and
/// down, space, and the buttons of gamepads and mice.
[[nodiscard]] const std::vector<int>& clicker_keys();
/// The code of "enter", "KEY_ENTER", "volumeup", "BTN_0"; negative for an unknown name.
[[nodiscard]] int key_code(const std::string& name);

/// A device node, read by libevdev. Refuses a path that is not an event device, can't be read, or
/// has none of the chosen keys. A full keyboard is never grabbed, since the program could then not
/// be stopped with it.
[[nodiscard]] Result<std::unique_ptr<KeyEvents>> open_evdev_keys(const std::string& path,
                                                                 const KeyChoice& choice);
/// `struct input_event`s from a file, or from a FIFO that another program writes to. Refuses a file
/// that can't be read, holds anything else, mixes clocks, or in which none of `codes` is pressed.
/// An event in a FIFO may be stamped by any clock of this machine that devices are read with; one
/// whose stamp fits none is refused when it is read.
[[nodiscard]] Result<std::unique_ptr<KeyEvents>> open_recorded_keys(const std::string& path,
                                                                    const std::vector<int>& codes);

/// The properties of a device node, without keeping it open: used to choose one, and by `doctor`.
struct KeyDevice {
  std::string path;
  std::string name;
  bool full_keyboard = false;
};
[[nodiscard]] Result<KeyDevice> describe_evdev(const std::string& path);

}  // namespace orthonav::desktop
