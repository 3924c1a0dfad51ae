#pragma once

#include <array>
#include <string>

#include "base/result.h"
#include "hal/openxr/runtime.h"

namespace orthonav::openxr {

/// The surgeon's input by controllers, hands and eyes: the actions of one action set, and the
/// inputs of the devices that they are bound to.
class Actions {
 public:
  Actions() = default;
  ~Actions() { destroy(); }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;

  /// Makes the actions and suggests bindings for the devices that the runtime knows; once per
  /// runtime.
  Status create(const Runtime& runtime);
  void destroy();
  /// Attaches the actions to a new session; once per session.
  Status attach(XrSession session) const;
  /// Updates the states of the actions. XR_SESSION_NOT_FOCUSED: no input reaches the application.
  XrResult sync(XrSession session) const;

  /// The button of a controller, in either hand.
  [[nodiscard]] XrAction select() const { return select_; }
  /// How far thumb and index finger are closed, 0 to 1, for each hand; null if no device reports
  /// it.
  [[nodiscard]] XrAction pinch() const { return pinch_; }
  /// Whether a hand is held ready to pinch; null if no device reports it.
  [[nodiscard]] XrAction ready() const { return ready_; }
  /// Where the eyes look, a pose; null if no device reports it.
  [[nodiscard]] XrAction gaze() const { return gaze_; }
  /// "/user/hand/left", "/user/hand/right".
  [[nodiscard]] const std::array<XrPath, 2>& hands() const { return hands_; }

 private:
  Status make_hands(XrInstance instance);
  Status make(const char* name, const char* shown, XrActionType type, bool by_hand,
              XrAction& action) const;
  Status suggest_select(const Runtime& runtime) const;
  Status suggest_hands(const Runtime& runtime);
  Status suggest_gaze(const Runtime& runtime);

  XrActionSet set_ = XR_NULL_HANDLE;
  XrAction select_ = XR_NULL_HANDLE;
  XrAction pinch_ = XR_NULL_HANDLE;
  XrAction ready_ = XR_NULL_HANDLE;
  XrAction gaze_ = XR_NULL_HANDLE;
  std::array<XrPath, 2> hands_{};
};

}  // namespace orthonav::openxr
