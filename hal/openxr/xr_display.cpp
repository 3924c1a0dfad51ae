#include "hal/openxr/xr_display.h"

#include <limits>
#include <utility>

#include "hal/openxr/xr_error.h"

namespace orthonav::openxr {

XrDisplay::~XrDisplay() {
  close();
  actions_.destroy();
}

/// After any failure, the next attempt starts from scratch.
Result<GraphicsNeeds> XrDisplay::open() {
  auto needs = connect();
  instance_lost_ = !needs.ok();
  return needs;
}

Result<EyeImages> XrDisplay::start(const VulkanObjects& objects,
                                   const FormatPreference& preference) {
  auto images = make_all(objects, preference);
  instance_lost_ = !images.ok();
  return images;
}

Result<GraphicsNeeds> XrDisplay::connect() {
  if (!runtime() || instance_lost_) {
    actions_.destroy();
    {
      const MutexLock lock(mutex_);
      runtime_.reset();
    }
    auto connected = Runtime::connect();
    if (!connected) {
      return connected.error();
    }
    if (const Status made = actions_.create(**connected); !made) {
      return made.error();
    }
    const MutexLock lock(mutex_);
    runtime_ = std::move(*connected);
  }
  if (const Status found = runtime()->find_headset(); !found) {
    return found.error();
  }
  const auto traits = runtime()->headset_traits();
  if (!traits) {
    return traits.error();
  }
  traits_ = *traits;
  {
    const MutexLock lock(mutex_);
    headset_name_ = traits_.name;
  }
  const auto setup = view_setup_of(*runtime(), traits_);
  if (!setup) {
    return setup.error();
  }
  setup_ = *setup;
  const auto versions = runtime()->vulkan_versions();
  if (!versions) {
    return versions.error();
  }
  return GraphicsNeeds{*versions, blend_of(setup_.blend)};
}

Result<void*> XrDisplay::create_instance(VulkanFunction get_proc, const void* info) {
  return runtime()->create_vulkan_instance(get_proc, info);
}

Result<void*> XrDisplay::physical_device(void* instance) {
  return runtime()->vulkan_device(instance);
}

Result<void*> XrDisplay::create_device(void* physical, VulkanFunction get_proc, const void* info) {
  return runtime()->create_vulkan_device(physical, get_proc, info);
}

Result<EyeImages> XrDisplay::make_all(const VulkanObjects& objects,
                                      const FormatPreference& preference) {
  if (const Status made = make_session(objects); !made) {
    return made.error();
  }
  if (const Status attached = actions_.attach(session_); !attached) {
    return attached.error();
  }
  if (traits_.sees_eyes) {
    gaze_.create(actions_, session_);
  }
  if (traits_.sees_hands) {
    joints_.create(*runtime(), session_);
  }
  if (const Status made = make_spaces(); !made) {
    return made.error();
  }
  near_m_ = preference.near_m();
  const bool depth = runtime()->has(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
  if (const Status made = swapchains_.create(session_, setup_, preference, depth); !made) {
    return made.error();
  }
  EyeImages images = swapchains_.images();
  images.panel = panel_.create(session_, setup_, images.format, preference.panel_px());
  return images;
}

Status XrDisplay::make_session(const VulkanObjects& objects) {
  XrGraphicsBindingVulkan2KHR binding = {XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR};
  binding.instance = static_cast<VkInstance>(objects.instance);
  binding.physicalDevice = static_cast<VkPhysicalDevice>(objects.physical);
  binding.device = static_cast<VkDevice>(objects.device);
  binding.queueFamilyIndex = objects.queue_family;
  binding.queueIndex = objects.queue_index;
  XrSessionCreateInfo info = {XR_TYPE_SESSION_CREATE_INFO};
  info.next = &binding;
  info.systemId = runtime()->system();
  state_ = {};
  end_asked_ = false;
  return status_of("create a session", xrCreateSession(runtime()->instance(), &info, &session_));
}

Status XrDisplay::make_spaces() {
  std::uint32_t count = 0;
  XrResult result = xrEnumerateReferenceSpaces(session_, 0, &count, nullptr);
  std::vector<XrReferenceSpaceType> offered(count);
  if (XR_SUCCEEDED(result)) {
    result = xrEnumerateReferenceSpaces(session_, count, &count, offered.data());
  }
  if (XR_FAILED(result)) {
    return error_of("ask for its reference spaces", result);
  }
  space_type_ = best_space(offered);
  const auto make = [this](XrReferenceSpaceType type, XrSpace& space) {
    XrReferenceSpaceCreateInfo info = {XR_TYPE_REFERENCE_SPACE_CREATE_INFO};
    info.referenceSpaceType = type;
    info.poseInReferenceSpace.orientation.w = 1.0f;
    return xrCreateReferenceSpace(session_, &info, &space);
  };
  const MutexLock lock(mutex_);
  result = make(space_type_, space_);
  if (XR_SUCCEEDED(result)) {
    result = make(XR_REFERENCE_SPACE_TYPE_VIEW, viewer_);
  }
  if (XR_FAILED(result)) {
    return error_of("create a space", result);
  }
  // A new session has a new space; where it is in the old one is not known.
  const auto now = runtime_->now();
  if (!now) {
    return now.error();
  }
  if (std::exchange(had_session_, true)) {
    anchor_.move(*now, std::nullopt);
  }
  return {};
}

void XrDisplay::ask_to_end() {
  end_asked_ = true;
  if (state_.running()) {
    xrRequestExitSession(session_);
  }
}

void XrDisplay::close() {
  swapchains_.destroy();
  panel_.destroy();
  gaze_.destroy();
  joints_.destroy();
  {
    const MutexLock lock(mutex_);
    if (viewer_ != XR_NULL_HANDLE) {
      xrDestroySpace(viewer_);
    }
    if (space_ != XR_NULL_HANDLE) {
      xrDestroySpace(space_);
    }
    space_ = viewer_ = XR_NULL_HANDLE;
    if (const auto change = button_.let_go(0)) {
      button_changes_.push_back({change->down, clock_.now(), change->lost});
    }
  }
  if (session_ != XR_NULL_HANDLE) {
    xrDestroySession(session_);
  }
  session_ = XR_NULL_HANDLE;
  state_ = {};
}

std::string XrDisplay::name() const {
  const MutexLock lock(mutex_);
  return runtime_ ? runtime_->name() + ", " + headset_name_ : "";
}

std::optional<XrTime> XrDisplay::xr_time(Timestamp at) const {
  if (!runtime_) {
    return std::nullopt;
  }
  const auto now = runtime_->now();
  if (!now) {
    return std::nullopt;
  }
  return *now + (at - clock_.now()).count();
}

std::optional<Timestamp> XrDisplay::timestamp(XrTime at) const {
  const auto now = runtime()->now();
  if (!now) {
    return std::nullopt;
  }
  return clock_.now() + Duration(at - *now);
}

XrDisplay::Located XrDisplay::locate_viewer(XrTime at) const {
  XrSpaceLocation location = {XR_TYPE_SPACE_LOCATION};
  if (space_ == XR_NULL_HANDLE || XR_FAILED(xrLocateSpace(viewer_, space_, at, &location))) {
    return {};
  }
  constexpr XrSpaceLocationFlags kKnown =
      XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
  constexpr XrSpaceLocationFlags kTracked =
      XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
  // With cameras elsewhere the position in the room is not needed: a headset that tracks only
  // rotation is assumed not to move.
  if (mount_.placement == Placement::kElsewhere &&
      (location.locationFlags & kKnown) == XR_SPACE_LOCATION_ORIENTATION_VALID_BIT) {
    location.pose.position = {};
  } else if ((location.locationFlags & kKnown) != kKnown) {
    return {};
  }
  const auto pose = transform_of<Space, Viewer>(location.pose);
  if (!pose) {
    return {};
  }
  const bool tracked = (location.locationFlags & kTracked) == kTracked;
  return {*pose, tracked ? PoseStatus::kMeasured : PoseStatus::kPredicted};
}

Tracked<Transform<World, Rig>> XrDisplay::world_from_rig(Timestamp at) const {
  Tracked<Transform<World, Rig>> answer;
  answer.time = at;
  const MutexLock lock(mutex_);
  const auto time = xr_time(at);
  if (!time) {
    return answer;
  }
  const Located viewer = locate_viewer(*time);
  const auto world_from_space = anchor_.world_from_space(*time);
  if (viewer.status == PoseStatus::kLost || !world_from_space) {
    return answer;
  }
  answer.value = *world_from_space * viewer.space_from_viewer * mount_.rig_from_viewer.inverse();
  const bool ahead = at > clock_.now();
  answer.status = ahead ? PoseStatus::kPredicted : viewer.status;
  return answer;
}

std::int64_t XrDisplay::map_epoch(Timestamp at) const {
  const MutexLock lock(mutex_);
  // Without a runtime nothing moves: the newest map still holds.
  return anchor_.epoch(xr_time(at).value_or(std::numeric_limits<XrTime>::max()));
}

void XrDisplay::take_button(Timestamp until, std::vector<ButtonChange>& changes) {
  const MutexLock lock(mutex_);
  while (!button_changes_.empty() && button_changes_.front().time <= until) {
    changes.push_back(button_changes_.front());
    button_changes_.pop_front();
  }
}

}  // namespace orthonav::openxr
