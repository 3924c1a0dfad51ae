#include "hal/openxr/hand_joints.h"

#include <cmath>

#include "hal/openxr/pinch.h"

namespace orthonav::openxr {

void HandJoints::create(const Runtime& runtime, XrSession session) {
  PFN_xrCreateHandTrackerEXT make = nullptr;
  const bool loaded = runtime.load("xrCreateHandTrackerEXT", make) &&
                      runtime.load("xrDestroyHandTrackerEXT", destroy_) &&
                      runtime.load("xrLocateHandJointsEXT", locate_);
  for (std::size_t i = 0; loaded && i < trackers_.size(); ++i) {
    XrHandTrackerCreateInfoEXT info = {XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT};
    info.hand = i == 0 ? XR_HAND_LEFT_EXT : XR_HAND_RIGHT_EXT;
    if (XR_FAILED(make(session, &info, &trackers_[i]))) {
      trackers_[i] = XR_NULL_HANDLE;
      destroy();
      return;
    }
  }
  if (!loaded) {
    destroy();
  }
}

void HandJoints::destroy() {
  for (XrHandTrackerEXT& tracker : trackers_) {
    if (tracker != XR_NULL_HANDLE) {
      destroy_(tracker);
    }
    tracker = XR_NULL_HANDLE;
  }
  destroy_ = nullptr;
  locate_ = nullptr;
}

std::optional<float> HandJoints::closed(std::size_t hand, XrSpace space, XrTime at) const {
  XrHandJointsLocateInfoEXT info = {XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT};
  info.baseSpace = space;
  info.time = at;
  std::array<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT> joints{};
  XrHandJointLocationsEXT locations = {XR_TYPE_HAND_JOINT_LOCATIONS_EXT};
  locations.jointCount = static_cast<std::uint32_t>(joints.size());
  locations.jointLocations = joints.data();
  if (XR_FAILED(locate_(trackers_[hand], &info, &locations)) || locations.isActive == XR_FALSE) {
    return std::nullopt;
  }
  constexpr XrSpaceLocationFlags kTracked =
      XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
  const XrHandJointLocationEXT& thumb = joints[XR_HAND_JOINT_THUMB_TIP_EXT];
  const XrHandJointLocationEXT& index = joints[XR_HAND_JOINT_INDEX_TIP_EXT];
  if ((thumb.locationFlags & index.locationFlags & kTracked) != kTracked) {
    return std::nullopt;
  }
  const XrVector3f& a = thumb.pose.position;
  const XrVector3f& b = index.pose.position;
  const float apart_m = std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
  return std::isfinite(apart_m) ? std::optional(closed_at(apart_m)) : std::nullopt;
}

}  // namespace orthonav::openxr
