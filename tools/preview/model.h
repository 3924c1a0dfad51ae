#pragma once

#include <memory>
#include <utility>

#include "tools/preview/camera.h"
#include "tools/preview/gate.h"
#include "tools/preview/hologram_filter.h"
#include "tools/preview/keyboard.h"
#include "tools/preview/keys.h"
#include "tools/preview/timeline.h"

namespace orthonav::preview {

/// How a moment is viewed. The picture changes only with the moment or the look.
struct Look {
  Camera camera;
  HologramFilter holograms;
  bool tools = false;  ///< drawn as lines where they are tracked
  friend bool operator==(const Look&, const Look&) = default;
};

/// Requests that only the surrounding program can fulfil.
struct Wishes {
  bool screenshot = false;
  bool video = false;  ///< begin, or end
  bool restart = false;
  bool quit = false;
};

/// The actions of keys, mouse and panel, without a window: these and scripts make the same calls.
/// Time advances through the gate, clicks and phrases go to the keyboard, and the timeline shows
/// the past. One thread.
class PreviewModel {
 public:
  /// All three must outlive it.
  PreviewModel(Gate& gate, Keyboard& keyboard, Timeline& timeline)
      : gate_(gate), keyboard_(keyboard), timeline_(timeline) {}

  /// A key goes down or up; automatic repeats are ignored.
  void key(Key key, bool down);
  void pause(bool paused);
  void step_on();
  void step_back();
  /// Shows that pair, paused: at once if it has passed, otherwise as soon as it has.
  void scrub_to(std::int64_t pair);
  /// Shows the newest pair again.
  void live() { looked_at_.reset(); }
  void set_speed(double speed) { gate_.set_speed(speed); }
  void orbit(bool orbits);
  void mute(bool muted) { keyboard_.mute(muted); }
  /// Says a phrase as the surgeon; an empty phrase is ignored.
  void say(const std::string& phrase);
  /// Where the newest picture was seen from; an orbit begins there.
  void seen_from(const Transform<sim::Room, Eye>& stage_from_eye) { eye_ = stage_from_eye; }
  /// Another operation begins.
  void restarted() { live(); }

  /// The moment to be shown; null before the first.
  [[nodiscard]] std::shared_ptr<const Moment> shown() const;
  /// Whether it is paused and no passed pair is still being processed, so that the picture no
  /// longer changes.
  [[nodiscard]] bool at_rest() const;
  /// Whether another moment than the newest is shown.
  [[nodiscard]] bool looks_back() const;
  [[nodiscard]] Look& look() { return look_; }
  [[nodiscard]] bool panel() const { return panel_; }
  [[nodiscard]] bool help() const { return help_; }
  [[nodiscard]] const Gate& gate() const { return gate_; }
  [[nodiscard]] const Keyboard& keyboard() const { return keyboard_; }
  [[nodiscard]] const Timeline& timeline() const { return timeline_; }
  [[nodiscard]] Wishes take_wishes() { return std::exchange(wishes_, {}); }
  [[nodiscard]] Wishes& wishes() { return wishes_; }

 private:
  void obey(const KeyBinding& binding);
  void change_speed(bool faster);

  Gate& gate_;
  Keyboard& keyboard_;
  Timeline& timeline_;
  Look look_;
  Transform<sim::Room, Eye> eye_;
  std::shared_ptr<const Moment> looked_at_;  ///< null: the newest
  bool clicker_down_ = false;
  bool panel_ = true;
  bool help_ = false;
  Wishes wishes_;
};

}  // namespace orthonav::preview
