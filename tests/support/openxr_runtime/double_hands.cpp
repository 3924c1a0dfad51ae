#include "tests/support/openxr_runtime/double_state.h"

// XR_EXT_hand_tracking.

namespace orthonav::test {
namespace {

DoubleTracker* tracker_of(Double& d, XrHandTrackerEXT handle) {
  auto* tracker = reinterpret_cast<DoubleTracker*>(handle);
  return d.session && d.session->trackers.count(tracker) > 0 ? tracker : nullptr;
}

XrResult XRAPI_CALL create_tracker(XrSession, const XrHandTrackerCreateInfoEXT* info,
                                   XrHandTrackerEXT* handle) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  if (!d.traits.sees_hands) {
    return d.violated("hands of a headset that sees none", XR_ERROR_FEATURE_UNSUPPORTED);
  }
  auto* tracker = new DoubleTracker{info->hand == XR_HAND_RIGHT_EXT ? std::size_t{1} : 0};
  d.session->trackers.insert(tracker);
  *handle = reinterpret_cast<XrHandTrackerEXT>(tracker);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy_tracker(XrHandTrackerEXT handle) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  DoubleTracker* tracker = tracker_of(d, handle);
  if (tracker == nullptr) {
    return d.violated("an unknown hand", XR_ERROR_HANDLE_INVALID);
  }
  d.session->trackers.erase(tracker);
  delete tracker;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL locate_joints(XrHandTrackerEXT handle, const XrHandJointsLocateInfoEXT* info,
                                  XrHandJointLocationsEXT* locations) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  const DoubleTracker* tracker = tracker_of(d, handle);
  if (tracker == nullptr ||
      d.session->spaces.count(reinterpret_cast<DoubleSpace*>(info->baseSpace)) == 0) {
    return d.violated("joints of no hand, or in no space", XR_ERROR_HANDLE_INVALID);
  }
  if (info->time <= 0 || locations->jointCount != XR_HAND_JOINT_COUNT_EXT) {
    return d.violated("joints of no time, or not as many as a hand has",
                      XR_ERROR_VALIDATION_FAILURE);
  }
  const HandState& hand = d.hands[tracker->hand];
  locations->isActive = hand.seen ? XR_TRUE : XR_FALSE;
  for (std::uint32_t i = 0; i < locations->jointCount; ++i) {
    XrHandJointLocationEXT& joint = locations->jointLocations[i];
    joint = {};
    joint.pose.orientation.w = 1.0f;
    joint.pose.position = {0, -0.3f, -0.4f};
    if (!hand.seen) {
      continue;
    }
    joint.locationFlags =
        XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
    if (hand.tips_tracked) {
      joint.locationFlags |=
          XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
    }
  }
  locations->jointLocations[XR_HAND_JOINT_INDEX_TIP_EXT].pose.position.x = hand.apart_m;
  return XR_SUCCESS;
}

}  // namespace

void add_hand_functions(std::map<std::string, PFN_xrVoidFunction>& table) {
  table["xrCreateHandTrackerEXT"] = as_void(create_tracker);
  table["xrDestroyHandTrackerEXT"] = as_void(destroy_tracker);
  table["xrLocateHandJointsEXT"] = as_void(locate_joints);
}

}  // namespace orthonav::test
