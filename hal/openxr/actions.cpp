#include "hal/openxr/actions.h"

#include <cstdio>
#include <vector>

#include "hal/openxr/xr_error.h"

namespace orthonav::openxr {
namespace {

constexpr std::array<const char*, 2> kHands = {"/user/hand/left", "/user/hand/right"};
constexpr const char* kHandInteraction = "XR_EXT_hand_interaction";

/// A kind of controller, defined by an extension, or by OpenXR itself (`extension` is null).
struct Controller {
  const char* extension;
  const char* profile;
  const char* button;
};
constexpr std::array<Controller, 2> kControllers = {{
    {nullptr, "/interaction_profiles/khr/simple_controller", "/input/select/click"},
    {"XR_ML_ml2_controller_interaction", "/interaction_profiles/ml/ml2_controller",
     "/input/trigger/click"},
}};

/// The bindings of one device.
class Suggestion {
 public:
  Suggestion(XrInstance instance, const char* profile) : instance_(instance), profile_(profile) {}

  Status add(XrAction action, const std::string& input) {
    XrPath path = XR_NULL_PATH;
    const XrResult made = xrStringToPath(instance_, input.c_str(), &path);
    bindings_.push_back({action, path});
    return status_of("name " + input, made);
  }
  /// Binds the same input of both hands.
  Status add_of_hands(XrAction action, const char* input) {
    const Status left = add(action, std::string(kHands[0]) + input);
    return left ? add(action, std::string(kHands[1]) + input) : left;
  }
  Status make() const {
    XrInteractionProfileSuggestedBinding suggestion = {
        XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING};
    XrResult result = xrStringToPath(instance_, profile_, &suggestion.interactionProfile);
    if (XR_SUCCEEDED(result)) {
      suggestion.countSuggestedBindings = static_cast<std::uint32_t>(bindings_.size());
      suggestion.suggestedBindings = bindings_.data();
      result = xrSuggestInteractionProfileBindings(instance_, &suggestion);
    }
    return status_of(std::string("suggest ") + profile_, result);
  }

 private:
  XrInstance instance_;
  const char* profile_;
  std::vector<XrActionSuggestedBinding> bindings_;
};

}  // namespace

Status Actions::make_hands(XrInstance instance) {
  for (std::size_t i = 0; i < kHands.size(); ++i) {
    if (const XrResult made = xrStringToPath(instance, kHands[i], &hands_[i]); XR_FAILED(made)) {
      return error_of(std::string("name ") + kHands[i], made);
    }
  }
  return {};
}

Status Actions::make(const char* name, const char* shown, XrActionType type, bool by_hand,
                     XrAction& action) const {
  XrActionCreateInfo info = {XR_TYPE_ACTION_CREATE_INFO};
  std::snprintf(info.actionName, sizeof(info.actionName), "%s", name);
  std::snprintf(info.localizedActionName, sizeof(info.localizedActionName), "%s", shown);
  info.actionType = type;
  if (by_hand) {
    info.countSubactionPaths = static_cast<std::uint32_t>(hands_.size());
    info.subactionPaths = hands_.data();
  }
  return status_of("create an action", xrCreateAction(set_, &info, &action));
}

Status Actions::create(const Runtime& runtime) {
  XrActionSetCreateInfo set = {XR_TYPE_ACTION_SET_CREATE_INFO};
  std::snprintf(set.actionSetName, sizeof(set.actionSetName), "surgeon");
  std::snprintf(set.localizedActionSetName, sizeof(set.localizedActionSetName), "Surgeon");
  const XrResult created = xrCreateActionSet(runtime.instance(), &set, &set_);
  if (XR_FAILED(created)) {
    return error_of("create an action set", created);
  }
  Status done = make_hands(runtime.instance());
  if (done) {
    done = make("select", "Select", XR_ACTION_TYPE_BOOLEAN_INPUT, false, select_);
  }
  if (done) {
    done = suggest_select(runtime);
  }
  if (done) {
    done = suggest_hands(runtime);
  }
  return done ? suggest_gaze(runtime) : done;
}

/// Every runtime must know the simple controller; other controllers are left out if it does not
/// know them.
Status Actions::suggest_select(const Runtime& runtime) const {
  for (const Controller& controller : kControllers) {
    if (controller.extension != nullptr && !runtime.has(controller.extension)) {
      continue;
    }
    Suggestion suggestion(runtime.instance(), controller.profile);
    Status done = suggestion.add_of_hands(select_, controller.button);
    if (done) {
      done = suggestion.make();
    }
    if (!done && controller.extension == nullptr) {
      return done;
    }
  }
  return {};
}

/// If a runtime offers hands and then refuses them, hands are not used.
Status Actions::suggest_hands(const Runtime& runtime) {
  const bool ext = runtime.has(kHandInteraction);
  if (!ext && !runtime.has(XR_MSFT_HAND_INTERACTION_EXTENSION_NAME)) {
    return {};
  }
  Status done = make("pinch", "Pinch", XR_ACTION_TYPE_FLOAT_INPUT, true, pinch_);
  if (done && ext) {
    done = make("pinch_ready", "Ready to pinch", XR_ACTION_TYPE_BOOLEAN_INPUT, true, ready_);
  }
  if (!done) {
    return done;
  }
  Suggestion suggestion(runtime.instance(),
                        ext ? "/interaction_profiles/ext/hand_interaction_ext"
                            : "/interaction_profiles/microsoft/hand_interaction");
  done = suggestion.add_of_hands(pinch_, ext ? "/input/pinch_ext/value" : "/input/select/value");
  if (done && ext) {
    done = suggestion.add_of_hands(ready_, "/input/pinch_ext/ready_ext");
  }
  if (!done || !suggestion.make()) {
    pinch_ = ready_ = XR_NULL_HANDLE;
  }
  return {};
}

Status Actions::suggest_gaze(const Runtime& runtime) {
  if (!runtime.has(XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME)) {
    return {};
  }
  const Status made = make("gaze", "Gaze", XR_ACTION_TYPE_POSE_INPUT, false, gaze_);
  if (!made) {
    return made;
  }
  Suggestion suggestion(runtime.instance(), "/interaction_profiles/ext/eye_gaze_interaction");
  if (!suggestion.add(gaze_, "/user/eyes_ext/input/gaze_ext/pose") || !suggestion.make()) {
    gaze_ = XR_NULL_HANDLE;
  }
  return {};
}

void Actions::destroy() {
  if (set_ != XR_NULL_HANDLE) {
    xrDestroyActionSet(set_);  // its actions go with it
  }
  set_ = XR_NULL_HANDLE;
  select_ = pinch_ = ready_ = gaze_ = XR_NULL_HANDLE;
}

Status Actions::attach(XrSession session) const {
  XrSessionActionSetsAttachInfo info = {XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO};
  info.countActionSets = 1;
  info.actionSets = &set_;
  return status_of("attach the action set", xrAttachSessionActionSets(session, &info));
}

XrResult Actions::sync(XrSession session) const {
  const XrActiveActionSet active = {set_, XR_NULL_PATH};
  XrActionsSyncInfo sync = {XR_TYPE_ACTIONS_SYNC_INFO};
  sync.countActiveActionSets = 1;
  sync.activeActionSets = &active;
  return xrSyncActions(session, &sync);
}

}  // namespace orthonav::openxr
