#include "hal/openxr/select_button.h"

#include <utility>

#include "hal/openxr/xr_error.h"

namespace orthonav::openxr {
namespace {

XrActionStateGetInfo get_of(XrAction action, XrPath hand) {
  XrActionStateGetInfo get = {XR_TYPE_ACTION_STATE_GET_INFO};
  get.action = action;
  get.subactionPath = hand;
  return get;
}

}  // namespace

/// How far a hand is closed; absent if that is unknown, or if its pose is not one that precedes a
/// pinch.
std::optional<float> SelectButton::closed(const Actions& actions, const Hands& hands,
                                          std::size_t hand, XrSession session, XrTime now) const {
  if (actions.pinch() == XR_NULL_HANDLE) {
    return hands.joints.offered() ? hands.joints.closed(hand, hands.space, now) : std::nullopt;
  }
  XrActionStateGetInfo get = get_of(actions.pinch(), actions.hands()[hand]);
  XrActionStateFloat value = {XR_TYPE_ACTION_STATE_FLOAT};
  if (XR_FAILED(xrGetActionStateFloat(session, &get, &value)) || !value.isActive) {
    return std::nullopt;
  }
  if (actions.ready() == XR_NULL_HANDLE || pinches_[hand].down()) {
    return value.currentState;
  }
  get = get_of(actions.ready(), actions.hands()[hand]);
  XrActionStateBoolean ready = {XR_TYPE_ACTION_STATE_BOOLEAN};
  const bool is_ready = XR_SUCCEEDED(xrGetActionStateBoolean(session, &get, &ready)) &&
                        ready.isActive && ready.currentState;
  return is_ready ? std::optional(value.currentState) : std::nullopt;
}

/// Whether either hand pinches.
bool SelectButton::take_hands(const Actions& actions, const Hands& hands, XrSession session,
                              XrTime now) {
  bool down = false;
  hands_stay_ = true;
  for (std::size_t hand = 0; hand < pinches_.size(); ++hand) {
    const std::optional<float> fraction = closed(actions, hands, hand, session, now);
    hands_stay_ = hands_stay_ && (fraction || !pinches_[hand].down());
    down = pinches_[hand].take(fraction) || down;
  }
  return down;
}

Result<std::optional<SelectButton::Change>> SelectButton::poll(const Actions& actions,
                                                               const Hands& hands,
                                                               XrSession session, XrTime now) {
  const XrActionStateGetInfo get = get_of(actions.select(), XR_NULL_PATH);
  XrActionStateBoolean select = {XR_TYPE_ACTION_STATE_BOOLEAN};
  const XrResult told = xrGetActionStateBoolean(session, &get, &select);
  if (XR_FAILED(told)) {
    return error_of("ask for the button", told);
  }
  const bool pinched = take_hands(actions, hands, session, now);
  const bool selected = select.isActive && select.currentState == XR_TRUE;
  const bool down = selected || pinched;
  if (down == down_) {
    return std::optional<Change>();
  }
  down_ = down;
  if (down) {
    by_hand_ = !selected;
  }
  // The runtime reports when a button changed, but not when a controller disappeared.
  const bool told_when = !by_hand_ && select.isActive;
  const bool lost = !down && (by_hand_ ? !hands_stay_ : !select.isActive);
  return std::optional<Change>({down, told_when ? select.lastChangeTime : now, lost});
}

std::optional<SelectButton::Change> SelectButton::let_go(XrTime now) {
  pinches_ = {};
  if (!std::exchange(down_, false)) {
    return std::nullopt;
  }
  return Change{false, now, true};
}

}  // namespace orthonav::openxr
