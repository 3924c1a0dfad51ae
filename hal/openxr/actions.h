#pragma once

#include <array>
#include <string>

#include "base/result.h"
#include "hal/openxr/runtime.h"

namespace orthonav::openxr {

/// What the surgeon does with controllers, hands and eyes: the actions of one set, and which inputs
/// of which device they come from.
class Actions {
 public:
  Actions() = default;
  ~Actions() { destroy(); }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;

  /// Makes them and suggests bindings for the devices that the runtime knows; once per runtime.
  Status create(const Runtime& runtime);
  void destroy();
  /// Attaches them to a new session; once per session.
  Status attach(XrSession session) const;
  /// Takes what they are now. XR_SESSION_NOT_FOCUSED: no input reaches the application.
  XrResult sync(XrSession session) const;

  /// The button of a controller, in either hand.
  [[nodiscard]] XrAction select() const { return select_; }
  /// How far thumb and index finger are closed, of each hand, 0 to 1; null where no device tells.
  [[nodiscard]] XrAction pinch() const { return pinch_; }
  /// Whether the hand is held as one that is about to pinch; null where no device tells.
  [[nodiscard]] XrAction ready() const { return ready_; }
  /// Where the eyes look, a pose; null where no device tells.
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
