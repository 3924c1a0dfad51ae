#include "hal/openxr/gaze_ray.h"

namespace orthonav::openxr {

void GazeRay::create(const Actions& actions, XrSession session) {
  action_ = actions.gaze();
  session_ = session;
  if (action_ == XR_NULL_HANDLE) {
    return;
  }
  XrActionSpaceCreateInfo info = {XR_TYPE_ACTION_SPACE_CREATE_INFO};
  info.action = action_;
  info.poseInActionSpace.orientation.w = 1.0f;
  if (XR_FAILED(xrCreateActionSpace(session, &info, &gaze_))) {
    gaze_ = XR_NULL_HANDLE;
  }
}

void GazeRay::destroy() {
  if (gaze_ != XR_NULL_HANDLE) {
    xrDestroySpace(gaze_);
  }
  gaze_ = XR_NULL_HANDLE;
}

std::optional<GazeRay::Seen> GazeRay::locate(XrSpace space, XrTime at, XrTime now) const {
  if (gaze_ == XR_NULL_HANDLE) {
    return std::nullopt;
  }
  XrActionStateGetInfo get = {XR_TYPE_ACTION_STATE_GET_INFO};
  get.action = action_;
  XrActionStatePose state = {XR_TYPE_ACTION_STATE_POSE};
  if (XR_FAILED(xrGetActionStatePose(session_, &get, &state)) || !state.isActive) {
    return std::nullopt;
  }
  XrEyeGazeSampleTimeEXT sample = {XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT};
  XrSpaceLocation location = {XR_TYPE_SPACE_LOCATION};
  location.next = &sample;
  constexpr XrSpaceLocationFlags kTracked =
      XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT |
      XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
  if (XR_FAILED(xrLocateSpace(gaze_, space, at, &location)) ||
      (location.locationFlags & kTracked) != kTracked) {
    return std::nullopt;
  }
  if (sample.time <= 0 || now - sample.time > kOldest_ns) {
    return std::nullopt;
  }
  const auto pose = transform_of<Space, GazePose>(location.pose);
  return pose ? std::optional(Seen{*pose, sample.time}) : std::nullopt;
}

}  // namespace orthonav::openxr
