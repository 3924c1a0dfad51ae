#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/api/devices.h"
#include "hal/desktop/input_folder.h"
#include "hal/desktop/key_events.h"

namespace orthonav::desktop {

struct ClickerOptions {
  std::string device;  ///< path of a device node, file or FIFO; or part of a device's name
  KeyChoice keys = {clicker_keys(), true};
  bool full_keyboard = false;  ///< whether a full keyboard may be chosen; one is never grabbed
  std::string folder = "/dev/input";  ///< where devices appear and disappear
  /// A contact bounces for a few milliseconds; a release counts once it has lasted this long.
  Duration debounce = std::chrono::milliseconds(15);
  Duration double_within = std::chrono::milliseconds(300);
  Duration hold_after = std::chrono::milliseconds(500);

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// Keys of a Bluetooth clicker, a keyboard or a foot pedal as one button, which is down while any
/// of the chosen keys is. A device that disappears releases the button; when it comes back, it is
/// used again. While there is no device, and while nobody writes to a FIFO, `poll` says so with
/// `ErrorCode::kUnavailable`. It does all the work and never waits.
class EvdevClicker : public Clicker {
 public:
  /// Borrows the headset's clock. Refuses invalid options, a file that is missing or can't be read,
  /// and what is not a device; a device that is not there yet is waited for.
  static Result<std::unique_ptr<EvdevClicker>> open(const ClickerOptions& options,
                                                    const Clock& clock);

 private:
  struct Change {
    bool down = false;
    Timestamp time{};
  };

  ClickerOptions options_;
  const Clock& clock_;
  Timestamp opened_at_{};
  std::optional<InputFolder> folder_;
  std::unique_ptr<KeyEvents> keys_;
  Status absent_;                ///< why there is no device, while `keys_` is null
  Status untold_;                ///< what was refused or disappeared, until `poll` can say it
  std::vector<KeyEvent> read_;   // reused
  std::vector<int> down_;        ///< codes of the keys that are down
  std::vector<Change> changes_;  ///< of the button, not delivered yet
  ClickTimer timer_;
  Timestamp told_until_ = Timestamp::min();

  EvdevClicker(const ClickerOptions& options, const Clock& clock);
  Status do_poll(Timestamp until, std::vector<ClickerEvent>& events) override;
  void find();
  Status take_up(const std::string& path);
  Status read_keys();
  void press_or_release(int code, bool down, Timestamp time);
  void tell(Timestamp until, std::vector<ClickerEvent>& events);
};

}  // namespace orthonav::desktop
