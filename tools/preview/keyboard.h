#pragma once

#include <string>
#include <vector>

#include "base/mutex.h"
#include "hal/api/devices.h"
#include "hal/api/shared_button.h"

namespace orthonav::preview {

/// Input typed since the devices were last polled: one thread types, another polls. It has no
/// times: input takes effect at the time of the next poll, by the headset's own clock, so nothing
/// happens while that clock stands still.
class Keyboard {
 public:
  void button(bool down);
  void say(std::string phrase);
  /// Whether the headset's own clicker and voice are ignored.
  void mute(bool muted);
  [[nodiscard]] bool muted() const;

  // For the devices. Each appends and forgets.
  void take_button(std::vector<bool>& downs);
  void take_phrases(std::vector<std::string>& phrases);

 private:
  mutable Mutex mutex_;
  bool muted_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::vector<bool> downs_ ORTHONAV_GUARDED_BY(mutex_);
  std::vector<std::string> phrases_ ORTHONAV_GUARDED_BY(mutex_);
};

/// The headset's clicker and the keyboard's as one button.
class SharedClicker : public Clicker {
 public:
  SharedClicker(Clicker& inner, Keyboard& keyboard) : inner_(inner), keyboard_(keyboard) {}

 private:
  Status do_poll(Timestamp until, std::vector<ClickerEvent>& events) override;

  Clicker& inner_;
  Keyboard& keyboard_;
  ClickTimer timer_;
  SharedButton button_;
  std::vector<bool> downs_;
  std::vector<ClickerEvent> offered_;
};

/// Both voices; typed phrases come after heard ones.
class SharedVoice : public Voice {
 public:
  SharedVoice(Voice& inner, Keyboard& keyboard) : inner_(inner), keyboard_(keyboard) {}

 private:
  Status do_poll(Timestamp until, std::vector<Phrase>& phrases) override;

  Voice& inner_;
  Keyboard& keyboard_;
  std::vector<std::string> typed_;
};

}  // namespace orthonav::preview
