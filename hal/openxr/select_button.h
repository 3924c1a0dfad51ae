#pragma once

#include <array>
#include <optional>

#include "base/result.h"
#include "hal/openxr/actions.h"
#include "hal/openxr/hand_joints.h"
#include "hal/openxr/pinch.h"

namespace orthonav::openxr {

/// The button of whatever controller the surgeon holds, and the pinch of either hand, as one
/// button. Without any of them it is never pressed.
class SelectButton {
 public:
  struct Change {
    bool down = false;
    XrTime time = 0;
    bool lost = false;  ///< released because nothing is there any more that could hold it
  };
  /// Where hands are seen; `joints` may offer none.
  struct Hands {
    const HandJoints& joints;
    XrSpace space = XR_NULL_HANDLE;
  };

  /// The change since the last call, if there was one, after the actions were synchronised. A
  /// controller or a hand that goes away releases the button at once.
  Result<std::optional<Change>> poll(const Actions& actions, const Hands& hands, XrSession session,
                                     XrTime now);
  /// Releases the button: the session is gone or has lost the focus.
  std::optional<Change> let_go(XrTime now);

 private:
  std::optional<float> closed(const Actions& actions, const Hands& hands, std::size_t hand,
                              XrSession session, XrTime now) const;
  bool take_hands(const Actions& actions, const Hands& hands, XrSession session, XrTime now);

  std::array<Pinch, 2> pinches_{};
  bool hands_stay_ = true;  ///< no hand that pinched went out of sight
  bool down_ = false;
  bool by_hand_ = false;  ///< it was pressed by a pinch
};

}  // namespace orthonav::openxr
