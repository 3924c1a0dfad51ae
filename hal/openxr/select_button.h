#pragma once

#include <optional>

#include "base/result.h"
#include "hal/openxr/runtime.h"

namespace orthonav::openxr {

/// The "select" of whatever the surgeon holds, or the pinch of his hands, as one button. Works with
/// no controller at all: then it is never pressed.
class SelectButton {
 public:
  ~SelectButton() { destroy(); }
  SelectButton() = default;
  SelectButton(const SelectButton&) = delete;
  SelectButton& operator=(const SelectButton&) = delete;

  /// Actions and their bindings; once for each runtime.
  Status create(const Runtime& runtime);
  void destroy();
  /// To a new session, once.
  Status attach(XrSession session);

  struct Change {
    bool down = false;
    XrTime time = 0;
  };
  /// Asks for its position; a change since it was asked last, or nothing. Who drops the controller
  /// lets the button go, now.
  Result<std::optional<Change>> poll(XrSession session, XrTime now);
  /// Nobody can hold it any more: the session is gone or has lost the focus.
  std::optional<Change> let_go(XrTime now);

 private:
  XrActionSet set_ = XR_NULL_HANDLE;
  XrAction select_ = XR_NULL_HANDLE;
  bool down_ = false;
};

}  // namespace orthonav::openxr
