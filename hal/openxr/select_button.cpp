#include "hal/openxr/select_button.h"

#include <array>
#include <cstdio>
#include <string>
#include <utility>

#include "hal/openxr/xr_error.h"

namespace orthonav::openxr {
namespace {

/// The path of the button on one kind of controller, which an extension defines, or OpenXR itself
/// (null).
struct Profile {
  const char* extension;
  const char* path;
  const char* input;
};
constexpr std::array<Profile, 4> kProfiles = {{
    {nullptr, "/interaction_profiles/khr/simple_controller", "/input/select/click"},
    {XR_MSFT_HAND_INTERACTION_EXTENSION_NAME, "/interaction_profiles/microsoft/hand_interaction",
     "/input/select/value"},
    {"XR_EXT_hand_interaction", "/interaction_profiles/ext/hand_interaction_ext",
     "/input/pinch_ext/value"},
    {"XR_ML_ml2_controller_interaction", "/interaction_profiles/ml/ml2_controller",
     "/input/trigger/click"},
}};

Result<XrPath> path_of(XrInstance instance, const std::string& text) {
  XrPath path = XR_NULL_PATH;
  const XrResult made = xrStringToPath(instance, text.c_str(), &path);
  if (XR_FAILED(made)) {
    return error_of("name " + text, made);
  }
  return path;
}

Status suggest(const Runtime& runtime, const Profile& profile, XrAction action) {
  const auto kind = path_of(runtime.instance(), profile.path);
  const auto left = path_of(runtime.instance(), std::string("/user/hand/left") + profile.input);
  const auto right = path_of(runtime.instance(), std::string("/user/hand/right") + profile.input);
  if (!kind || !left || !right) {
    return Error{"openxr: bad path of " + std::string(profile.path)};
  }
  const std::array<XrActionSuggestedBinding, 2> bindings = {{{action, *left}, {action, *right}}};
  XrInteractionProfileSuggestedBinding suggestion = {XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING};
  suggestion.interactionProfile = *kind;
  suggestion.countSuggestedBindings = 2;
  suggestion.suggestedBindings = bindings.data();
  return status_of(std::string("suggest ") + profile.path,
                   xrSuggestInteractionProfileBindings(runtime.instance(), &suggestion));
}

}  // namespace

Status SelectButton::create(const Runtime& runtime) {
  XrActionSetCreateInfo set = {XR_TYPE_ACTION_SET_CREATE_INFO};
  std::snprintf(set.actionSetName, sizeof(set.actionSetName), "surgeon");
  std::snprintf(set.localizedActionSetName, sizeof(set.localizedActionSetName), "Surgeon");
  XrResult result = xrCreateActionSet(runtime.instance(), &set, &set_);
  if (XR_FAILED(result)) {
    return error_of("create an action set", result);
  }
  XrActionCreateInfo action = {XR_TYPE_ACTION_CREATE_INFO};
  std::snprintf(action.actionName, sizeof(action.actionName), "select");
  std::snprintf(action.localizedActionName, sizeof(action.localizedActionName), "Select");
  action.actionType = XR_ACTION_TYPE_BOOLEAN_INPUT;
  result = xrCreateAction(set_, &action, &select_);
  if (XR_FAILED(result)) {
    return error_of("create an action", result);
  }
  // Every runtime knows the simple controller; others that it does not know are left out.
  for (const Profile& profile : kProfiles) {
    if (profile.extension != nullptr && !runtime.has(profile.extension)) {
      continue;
    }
    const Status suggested = suggest(runtime, profile, select_);
    if (!suggested && profile.extension == nullptr) {
      return suggested;
    }
  }
  return {};
}

void SelectButton::destroy() {
  if (set_ != XR_NULL_HANDLE) {
    xrDestroyActionSet(set_);
  }
  set_ = XR_NULL_HANDLE;
  select_ = XR_NULL_HANDLE;
}

Status SelectButton::attach(XrSession session) {
  XrSessionActionSetsAttachInfo info = {XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO};
  info.countActionSets = 1;
  info.actionSets = &set_;
  return status_of("attach the action set", xrAttachSessionActionSets(session, &info));
}

Result<std::optional<SelectButton::Change>> SelectButton::poll(XrSession session, XrTime now) {
  const XrActiveActionSet active = {set_, XR_NULL_PATH};
  XrActionsSyncInfo sync = {XR_TYPE_ACTIONS_SYNC_INFO};
  sync.countActiveActionSets = 1;
  sync.activeActionSets = &active;
  const XrResult synced = xrSyncActions(session, &sync);
  if (XR_FAILED(synced)) {
    return error_of("ask for input", synced);
  }
  if (synced == XR_SESSION_NOT_FOCUSED) {
    return let_go(now);
  }
  XrActionStateGetInfo get = {XR_TYPE_ACTION_STATE_GET_INFO};
  get.action = select_;
  XrActionStateBoolean state = {XR_TYPE_ACTION_STATE_BOOLEAN};
  const XrResult told = xrGetActionStateBoolean(session, &get, &state);
  if (XR_FAILED(told)) {
    return error_of("ask for the button", told);
  }
  if (!state.isActive) {
    return let_go(now);
  }
  const bool down = state.currentState == XR_TRUE;
  if (down == down_) {
    return std::optional<Change>();
  }
  down_ = down;
  return std::optional<Change>({down, state.lastChangeTime});
}

std::optional<SelectButton::Change> SelectButton::let_go(XrTime now) {
  if (!std::exchange(down_, false)) {
    return std::nullopt;
  }
  return Change{false, now};
}

}  // namespace orthonav::openxr
