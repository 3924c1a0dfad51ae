#pragma once

#include <optional>

#include "base/result.h"
#include "hal/openxr/runtime.h"

namespace orthonav::openxr {

/// The "select" of any controller that the surgeon holds, or the pinch of a hand, as one button.
/// Without a controller it is never pressed.
class SelectButton {
 public:
  ~SelectButton() { destroy(); }
  SelectButton() = default;
  SelectButton(const SelectButton&) = delete;
  SelectButton& operator=(const SelectButton&) = delete;

  /// Makes actions and their bindings; once per runtime.
  Status create(const Runtime& runtime);
  void destroy();
  /// Attaches them to a new session; once per session.
  Status attach(XrSession session);

  struct Change {
    bool down = false;
    XrTime time = 0;
  };
  /// The change since the last call, if there was one. A controller that disappears releases the
  /// button at once.
  Result<std::optional<Change>> poll(XrSession session, XrTime now);
  /// Releases the button: the session is gone or has lost the focus.
  std::optional<Change> let_go(XrTime now);

 private:
  XrActionSet set_ = XR_NULL_HANDLE;
  XrAction select_ = XR_NULL_HANDLE;
  bool down_ = false;
};

}  // namespace orthonav::openxr
