#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>

#include "tests/support/openxr_runtime/double_state.h"

namespace orthonav::test {
namespace {

XrResult XRAPI_CALL string_to_path(XrInstance, const char* text, XrPath* path) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (text[0] != '/') {
    return d.violated(std::string("path ") + text, XR_ERROR_PATH_FORMAT_INVALID);
  }
  for (const auto& [known, name] : d.paths) {
    if (name == text) {
      return *path = known, XR_SUCCESS;
    }
  }
  *path = static_cast<XrPath>(d.paths.size() + 1);
  d.paths[*path] = text;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL path_to_string(XrInstance, XrPath path, std::uint32_t capacity,
                                   std::uint32_t* count, char* text) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  const auto found = d.paths.find(path);
  if (found == d.paths.end()) {
    return XR_ERROR_PATH_INVALID;
  }
  *count = static_cast<std::uint32_t>(found->second.size() + 1);
  if (capacity == 0) {
    return XR_SUCCESS;
  }
  if (capacity < *count) {
    return XR_ERROR_SIZE_INSUFFICIENT;
  }
  std::memcpy(text, found->second.c_str(), *count);
  return XR_SUCCESS;
}

// There is only one action set, so its handle is a constant.
XrResult XRAPI_CALL create_action_set(XrInstance, const XrActionSetCreateInfo*, XrActionSet* set) {
  *set = reinterpret_cast<XrActionSet>(std::uintptr_t{0x5e7});
  return XR_SUCCESS;
}
XrResult XRAPI_CALL destroy_action_set(XrActionSet) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  d.action_list.clear();
  return XR_SUCCESS;
}

DoubleAction* action_of(Double& d, XrAction handle) {
  const auto found = std::find_if(
      d.action_list.begin(), d.action_list.end(),
      [handle](const auto& action) { return reinterpret_cast<XrAction>(action.get()) == handle; });
  return found == d.action_list.end() ? nullptr : found->get();
}

XrResult XRAPI_CALL create_action(XrActionSet, const XrActionCreateInfo* info, XrAction* handle) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  auto action = std::make_unique<DoubleAction>();
  action->type = info->actionType;
  for (std::uint32_t i = 0; i < info->countSubactionPaths; ++i) {
    const std::string& path = d.paths[info->subactionPaths[i]];
    if (path != "/user/hand/left" && path != "/user/hand/right") {
      return d.violated("a subaction path " + path, XR_ERROR_PATH_UNSUPPORTED);
    }
    action->hands.insert(info->subactionPaths[i]);
  }
  *handle = reinterpret_cast<XrAction>(action.get());
  d.action_list.insert(std::move(action));
  return XR_SUCCESS;
}
XrResult XRAPI_CALL destroy_action(XrAction) { return XR_SUCCESS; }

/// An input of a device; of either hand if `path` does not begin with "/user".
struct Input {
  const char* profile;
  const char* extension;  ///< null: none is needed
  const char* path;
  XrActionType type;
};
constexpr std::array<Input, 4> kInputs = {{
    {"/interaction_profiles/khr/simple_controller", nullptr, "/input/select/click",
     XR_ACTION_TYPE_BOOLEAN_INPUT},
    {"/interaction_profiles/ext/hand_interaction_ext", kHandInteraction, "/input/pinch_ext/value",
     XR_ACTION_TYPE_FLOAT_INPUT},
    {"/interaction_profiles/ext/hand_interaction_ext", kHandInteraction,
     "/input/pinch_ext/ready_ext", XR_ACTION_TYPE_BOOLEAN_INPUT},
    {"/interaction_profiles/ext/eye_gaze_interaction", XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME,
     "/user/eyes_ext/input/gaze_ext/pose", XR_ACTION_TYPE_POSE_INPUT},
}};

bool is_input(const Double& d, const Input& input, const std::string& profile,
              const std::string& path) {
  if (profile != input.profile ||
      (input.extension != nullptr && d.enabled.count(input.extension) == 0)) {
    return false;
  }
  const std::string name = input.path;
  return path == name || path == "/user/hand/left" + name || path == "/user/hand/right" + name;
}

XrResult XRAPI_CALL suggest(XrInstance, const XrInteractionProfileSuggestedBinding* suggestion) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (d.session && d.session->attached) {
    return d.violated("bindings after they were attached", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  }
  const std::string& profile = d.paths[suggestion->interactionProfile];
  for (std::uint32_t i = 0; i < suggestion->countSuggestedBindings; ++i) {
    const std::string& path = d.paths[suggestion->suggestedBindings[i].binding];
    DoubleAction* action = action_of(d, suggestion->suggestedBindings[i].action);
    if (action == nullptr) {
      return d.violated("a binding of no action", XR_ERROR_HANDLE_INVALID);
    }
    const auto input = std::find_if(kInputs.begin(), kInputs.end(), [&](const Input& one) {
      return is_input(d, one, profile, path);
    });
    if (input == kInputs.end()) {
      return d.violated("a binding of " + profile + " to " + path, XR_ERROR_PATH_UNSUPPORTED);
    }
    if (input->type != action->type) {
      return d.violated("a binding of another type to " + path, XR_ERROR_PATH_UNSUPPORTED);
    }
    action->bound.insert(path);
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL attach(XrSession, const XrSessionActionSetsAttachInfo*) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  if (d.session->attached) {
    return d.violated("attached twice", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  }
  d.session->attached = true;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL sync(XrSession, const XrActionsSyncInfo*) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  if (!d.session->attached) {
    return d.violated("input before it was attached", XR_ERROR_ACTIONSET_NOT_ATTACHED);
  }
  d.synced_controller = d.traits.controller;
  d.synced_pressed = d.pressed && d.traits.controller;
  d.synced_hands = d.hands;
  d.synced_gaze = d.gaze;
  return d.session->state == XR_SESSION_STATE_FOCUSED ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
}

/// Finds the action that is asked for; an error if the request is not valid.
XrResult asked(Double& d, const XrActionStateGetInfo* get, XrActionType type,
               const DoubleAction** action) {
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  *action = action_of(d, get->action);
  if (*action == nullptr) {
    return d.violated("the state of no action", XR_ERROR_HANDLE_INVALID);
  }
  if ((*action)->type != type) {
    return d.violated("the state of an action of another type", XR_ERROR_ACTION_TYPE_MISMATCH);
  }
  if (get->subactionPath != XR_NULL_PATH && (*action)->hands.count(get->subactionPath) == 0) {
    return d.violated("the state of a hand that the action was not made for",
                      XR_ERROR_PATH_UNSUPPORTED);
  }
  return XR_SUCCESS;
}

/// The hand that an action is asked about; null if it is not seen, holds a controller, or `input`
/// is not bound to the action.
const HandState* hand_of(Double& d, const DoubleAction& action, const XrActionStateGetInfo* get,
                         const char* input) {
  const std::string path = d.paths[get->subactionPath];
  const std::size_t hand = path == "/user/hand/right" ? 1 : 0;
  const bool free = hand == 0 || !d.synced_controller;
  const bool bound = action.bound.count(path + input) > 0;
  return bound && free && d.synced_hands[hand].seen ? &d.synced_hands[hand] : nullptr;
}

XrResult XRAPI_CALL state_boolean(XrSession, const XrActionStateGetInfo* get,
                                  XrActionStateBoolean* state) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  const DoubleAction* action = nullptr;
  if (const XrResult bad = asked(d, get, XR_ACTION_TYPE_BOOLEAN_INPUT, &action);
      bad != XR_SUCCESS) {
    return bad;
  }
  if (action->bound.count("/user/hand/right/input/select/click") > 0) {
    state->isActive = d.synced_controller ? XR_TRUE : XR_FALSE;
    state->currentState = d.synced_pressed ? XR_TRUE : XR_FALSE;
    state->lastChangeTime = d.pressed_at;
    return XR_SUCCESS;
  }
  const HandState* hand = hand_of(d, *action, get, "/input/pinch_ext/ready_ext");
  state->isActive = hand != nullptr ? XR_TRUE : XR_FALSE;
  state->currentState = hand != nullptr && hand->ready ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL state_float(XrSession, const XrActionStateGetInfo* get,
                                XrActionStateFloat* state) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  const DoubleAction* action = nullptr;
  if (const XrResult bad = asked(d, get, XR_ACTION_TYPE_FLOAT_INPUT, &action); bad != XR_SUCCESS) {
    return bad;
  }
  const HandState* hand = hand_of(d, *action, get, "/input/pinch_ext/value");
  state->isActive = hand != nullptr ? XR_TRUE : XR_FALSE;
  state->currentState = hand != nullptr ? hand->pinch : 0.0f;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL state_pose(XrSession, const XrActionStateGetInfo* get,
                               XrActionStatePose* state) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  const DoubleAction* action = nullptr;
  if (const XrResult bad = asked(d, get, XR_ACTION_TYPE_POSE_INPUT, &action); bad != XR_SUCCESS) {
    return bad;
  }
  state->isActive = d.synced_gaze.active && !action->bound.empty() ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL create_action_space(XrSession, const XrActionSpaceCreateInfo* info,
                                        XrSpace* handle) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  const DoubleAction* action = action_of(d, info->action);
  if (action == nullptr || action->type != XR_ACTION_TYPE_POSE_INPUT) {
    return d.violated("a space of no pose", XR_ERROR_ACTION_TYPE_MISMATCH);
  }
  auto* space = new DoubleSpace{XR_REFERENCE_SPACE_TYPE_VIEW, true};
  d.session->spaces.insert(space);
  *handle = reinterpret_cast<XrSpace>(space);
  return XR_SUCCESS;
}

}  // namespace

void add_input_functions(std::map<std::string, PFN_xrVoidFunction>& table) {
  table["xrStringToPath"] = as_void(string_to_path);
  table["xrPathToString"] = as_void(path_to_string);
  table["xrCreateActionSet"] = as_void(create_action_set);
  table["xrDestroyActionSet"] = as_void(destroy_action_set);
  table["xrCreateAction"] = as_void(create_action);
  table["xrDestroyAction"] = as_void(destroy_action);
  table["xrSuggestInteractionProfileBindings"] = as_void(suggest);
  table["xrAttachSessionActionSets"] = as_void(attach);
  table["xrSyncActions"] = as_void(sync);
  table["xrGetActionStateBoolean"] = as_void(state_boolean);
  table["xrGetActionStateFloat"] = as_void(state_float);
  table["xrGetActionStatePose"] = as_void(state_pose);
  table["xrCreateActionSpace"] = as_void(create_action_space);
}

}  // namespace orthonav::test
