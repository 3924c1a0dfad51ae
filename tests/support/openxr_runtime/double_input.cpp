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

// There is only one set and one action, so their handles are arbitrary.
XrResult XRAPI_CALL create_action_set(XrInstance, const XrActionSetCreateInfo*, XrActionSet* set) {
  *set = reinterpret_cast<XrActionSet>(std::uintptr_t{0x5e7});
  return XR_SUCCESS;
}
XrResult XRAPI_CALL destroy_action_set(XrActionSet) { return XR_SUCCESS; }
XrResult XRAPI_CALL create_action(XrActionSet, const XrActionCreateInfo* info, XrAction* action) {
  if (info->actionType != XR_ACTION_TYPE_BOOLEAN_INPUT) {
    return XR_ERROR_FEATURE_UNSUPPORTED;
  }
  *action = reinterpret_cast<XrAction>(std::uintptr_t{0xac7});
  return XR_SUCCESS;
}
XrResult XRAPI_CALL destroy_action(XrAction) { return XR_SUCCESS; }

XrResult XRAPI_CALL suggest(XrInstance, const XrInteractionProfileSuggestedBinding* suggestion) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (d.session && d.session->attached) {
    return d.violated("bindings after they were attached", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  }
  if (d.paths[suggestion->interactionProfile] != "/interaction_profiles/khr/simple_controller") {
    return d.violated("bindings of a profile that was not switched on", XR_ERROR_PATH_UNSUPPORTED);
  }
  for (std::uint32_t i = 0; i < suggestion->countSuggestedBindings; ++i) {
    const std::string& path = d.paths[suggestion->suggestedBindings[i].binding];
    if (path != "/user/hand/left/input/select/click" &&
        path != "/user/hand/right/input/select/click") {
      return d.violated("a binding to " + path, XR_ERROR_PATH_UNSUPPORTED);
    }
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
  d.synced_active = d.traits.controller;
  d.synced_pressed = d.pressed && d.traits.controller;
  return d.session->state == XR_SESSION_STATE_FOCUSED ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
}

XrResult XRAPI_CALL state_boolean(XrSession, const XrActionStateGetInfo*,
                                  XrActionStateBoolean* state) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  state->isActive = d.synced_active ? XR_TRUE : XR_FALSE;
  state->currentState = d.synced_pressed ? XR_TRUE : XR_FALSE;
  state->lastChangeTime = d.pressed_at;
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
}

}  // namespace orthonav::test
