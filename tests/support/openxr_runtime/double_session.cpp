#include <algorithm>

#include "tests/support/openxr_runtime/double_state.h"

namespace orthonav::test {
namespace {

XrResult XRAPI_CALL create_session(XrInstance, const XrSessionCreateInfo* info, XrSession* handle) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (d.instance_lost) {
    return XR_ERROR_INSTANCE_LOST;
  }
  if (d.session) {
    return d.violated("a second session", XR_ERROR_LIMIT_REACHED);
  }
  if (!d.requirements_asked) {
    return d.violated("a session before the graphics requirements were asked",
                      XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING);
  }
  const auto* binding = static_cast<const XrGraphicsBindingVulkan2KHR*>(info->next);
  if (binding == nullptr || binding->type != XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR) {
    return d.violated("a session without a graphics binding", XR_ERROR_GRAPHICS_DEVICE_INVALID);
  }
  if (binding->instance != d.vk_instance || binding->physicalDevice != d.vk_physical ||
      binding->device != d.vk_device) {
    return d.violated("a session on another device", XR_ERROR_GRAPHICS_DEVICE_INVALID);
  }
  d.session = std::make_unique<DoubleSession>();
  d.session->objects = {binding->instance, binding->physicalDevice, binding->device,
                        binding->queueFamilyIndex, binding->queueIndex};
  ++d.session_count;
  *handle = reinterpret_cast<XrSession>(d.session.get());
  d.enter(*d.session, XR_SESSION_STATE_IDLE);
  d.enter(*d.session, XR_SESSION_STATE_READY);
  return XR_SUCCESS;
}

void destroy_chains(DoubleSession& session) {
  for (DoubleSwapchain* chain : session.swapchains) {
    delete chain;
  }
  for (DoubleSpace* space : session.spaces) {
    delete space;
  }
  for (DoubleTracker* tracker : session.trackers) {
    delete tracker;
  }
  session.trackers.clear();
  session.swapchains.clear();
  session.spaces.clear();
}

XrResult XRAPI_CALL destroy_session(XrSession handle) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (!d.is_session(handle)) {
    return d.violated("an unknown session", XR_ERROR_HANDLE_INVALID);
  }
  destroy_chains(*d.session);
  d.session.reset();
  return XR_SUCCESS;
}

XrResult XRAPI_CALL begin_session(XrSession, const XrSessionBeginInfo* info) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  DoubleSession& session = *d.session;
  if (info->primaryViewConfigurationType != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) {
    return XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED;
  }
  if (session.running) {
    return d.violated("begun twice", XR_ERROR_SESSION_RUNNING);
  }
  if (session.state != XR_SESSION_STATE_READY) {
    return d.violated("begun before READY", XR_ERROR_SESSION_NOT_READY);
  }
  session.running = true;
  for (const XrSessionState state :
       {XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_VISIBLE, XR_SESSION_STATE_FOCUSED}) {
    d.enter(session, state);
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL end_session(XrSession) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  DoubleSession& session = *d.session;
  if (!session.running) {
    return d.violated("ended twice", XR_ERROR_SESSION_NOT_RUNNING);
  }
  if (session.state != XR_SESSION_STATE_STOPPING) {
    return d.violated("ended before STOPPING", XR_ERROR_SESSION_NOT_STOPPING);
  }
  if (session.waited || session.begun) {
    d.violated("ended with a frame open", XR_SUCCESS);
  }
  session.running = false;
  d.enter(session, XR_SESSION_STATE_IDLE);
  d.enter(session, session.exit_requested ? XR_SESSION_STATE_EXITING : XR_SESSION_STATE_READY);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL request_exit(XrSession) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  if (!d.session->running) {
    return d.violated("exit of what does not run", XR_ERROR_SESSION_NOT_RUNNING);
  }
  d.session->exit_requested = true;
  d.enter(*d.session, XR_SESSION_STATE_STOPPING);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL reference_spaces(XrSession, std::uint32_t capacity, std::uint32_t* count,
                                     XrReferenceSpaceType* types) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  return enumerate(d.traits.spaces, capacity, count, types);
}

XrResult XRAPI_CALL create_space(XrSession, const XrReferenceSpaceCreateInfo* info,
                                 XrSpace* handle) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  const auto& spaces = d.traits.spaces;
  if (std::find(spaces.begin(), spaces.end(), info->referenceSpaceType) == spaces.end()) {
    return d.violated("a space that was not offered", XR_ERROR_REFERENCE_SPACE_UNSUPPORTED);
  }
  auto* space = new DoubleSpace{info->referenceSpaceType};
  d.session->spaces.insert(space);
  *handle = reinterpret_cast<XrSpace>(space);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy_space(XrSpace handle) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  auto* space = reinterpret_cast<DoubleSpace*>(handle);
  if (!d.session || d.session->spaces.erase(space) == 0) {
    return d.violated("an unknown space", XR_ERROR_HANDLE_INVALID);
  }
  delete space;
  return XR_SUCCESS;
}

/// Where the eyes look, in a space, as seen when actions were last synchronised.
XrResult locate_gaze(const Double& d, const DoubleSpace& in, XrTime time,
                     XrSpaceLocation& location) {
  const GazeState& gaze = d.synced_gaze;
  location.locationFlags = 0;
  if (!gaze.active) {
    return XR_SUCCESS;
  }
  const bool on_head = in.type == XR_REFERENCE_SPACE_TYPE_VIEW;
  location.pose = on_head ? gaze.in_viewer : multiplied(d.viewer_at(time), gaze.in_viewer);
  location.locationFlags =
      XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
  if (gaze.tracked) {
    location.locationFlags |=
        XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
  }
  auto* sample = static_cast<XrEyeGazeSampleTimeEXT*>(location.next);
  if (sample != nullptr && sample->type == XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT) {
    sample->time = d.now() - gaze.age_ns;
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL locate_space(XrSpace viewer, XrSpace base, XrTime time,
                                 XrSpaceLocation* location) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  if (time <= 0) {
    return d.violated("a time of " + std::to_string(time), XR_ERROR_TIME_INVALID);
  }
  const auto* of = reinterpret_cast<DoubleSpace*>(viewer);
  const auto* in = reinterpret_cast<DoubleSpace*>(base);
  if (d.session->spaces.count(const_cast<DoubleSpace*>(of)) == 0 ||
      d.session->spaces.count(const_cast<DoubleSpace*>(in)) == 0) {
    return d.violated("a space of nobody's", XR_ERROR_HANDLE_INVALID);
  }
  if (of->of_gaze) {
    return locate_gaze(d, *in, time, *location);
  }
  if (location->next != nullptr) {
    return d.violated("a location with what it does not have", XR_ERROR_VALIDATION_FAILURE);
  }
  if (of->type != XR_REFERENCE_SPACE_TYPE_VIEW || in->type == XR_REFERENCE_SPACE_TYPE_VIEW) {
    return d.violated("spaces that this runtime can't relate", XR_ERROR_RUNTIME_FAILURE);
  }
  location->pose = d.viewer_at(time);
  if (!d.traits.position_known) {
    location->pose.position = {1e30f, -1e30f, 1e30f};
  }
  location->locationFlags = d.flags();
  return XR_SUCCESS;
}

constexpr XrViewStateFlags kAllFlags =
    XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT |
    XR_VIEW_STATE_ORIENTATION_TRACKED_BIT | XR_VIEW_STATE_POSITION_TRACKED_BIT;

XrResult XRAPI_CALL locate_views(XrSession, const XrViewLocateInfo* info, XrViewState* state,
                                 std::uint32_t capacity, std::uint32_t* count, XrView* views) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  if (info->displayTime <= 0) {
    return d.violated("views at no time", XR_ERROR_TIME_INVALID);
  }
  auto* space = reinterpret_cast<DoubleSpace*>(info->space);
  if (d.session->spaces.count(space) == 0) {
    return d.violated("views in a space of nobody's", XR_ERROR_HANDLE_INVALID);
  }
  const bool on_head = space->type == XR_REFERENCE_SPACE_TYPE_VIEW;
  // Where the eyes are on the head does not depend on whether the head is located.
  const XrViewStateFlags on_head_flags = d.traits.eyes_on_head ? kAllFlags : 0;
  state->viewStateFlags = on_head ? on_head_flags : d.flags();
  std::vector<XrView> both(2, {XR_TYPE_VIEW});
  for (std::size_t eye = 0; eye < 2; ++eye) {
    XrPosef offset = {{0, 0, 0, 1}, {eye == 0 ? -0.0315f : 0.0315f, 0, 0}};
    both[eye].pose = on_head ? offset : multiplied(d.viewer_at(info->displayTime), offset);
    // An unknown position may be anything.
    if (!d.traits.position_known && !on_head) {
      both[eye].pose.position = {1e30f, -1e30f, 1e30f};
    }
    const float inner = 0.40f;
    const float outer = 0.50f;
    both[eye].fov = {eye == 0 ? -outer : -inner, eye == 0 ? inner : outer, 0.36f, -0.40f};
  }
  return enumerate(both, capacity, count, views);
}

}  // namespace

void add_session_functions(std::map<std::string, PFN_xrVoidFunction>& table) {
  table["xrCreateSession"] = as_void(create_session);
  table["xrDestroySession"] = as_void(destroy_session);
  table["xrBeginSession"] = as_void(begin_session);
  table["xrEndSession"] = as_void(end_session);
  table["xrRequestExitSession"] = as_void(request_exit);
  table["xrEnumerateReferenceSpaces"] = as_void(reference_spaces);
  table["xrCreateReferenceSpace"] = as_void(create_space);
  table["xrDestroySpace"] = as_void(destroy_space);
  table["xrLocateSpace"] = as_void(locate_space);
  table["xrLocateViews"] = as_void(locate_views);
}

}  // namespace orthonav::test
