#include <array>

#include "hal/openxr/xr_display.h"

namespace orthonav::openxr {
namespace {

constexpr XrViewStateFlags kKnown =
    XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;

/// The eyes of a head whose position is unknown: at the origin, as far apart as eyes are.
void stand_still(std::array<XrView, 2>& views) {
  constexpr double kHalfApart_m = 0.0315;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    XrPosef& pose = views[eye].pose;
    pose.position = {};
    const auto rotated = transform_of<Space, Eye>(pose);
    if (!rotated) {
      continue;
    }
    const Vec3 at = (*rotated * Direction<Eye>{{eye == 0 ? -kHalfApart_m : kHalfApart_m, 0, 0}}).v;
    pose.position = {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
  }
}

}  // namespace

/// Places World, if it is not placed yet, as soon as the poses of both heads are known.
void XrDisplay::lay_world(XrTime at) {
  {
    const MutexLock lock(mutex_);
    if (anchor_.world_from_space(at)) {
      return;
    }
  }
  const auto world_from_rig = cameras_head_.world_from_rig(clock_.now());
  if (world_from_rig.status == PoseStatus::kLost) {
    return;
  }
  const MutexLock lock(mutex_);
  const Located viewer = locate_viewer(at);
  if (viewer.status == PoseStatus::kLost) {
    return;
  }
  anchor_.lay(at, world_from_rig.value * mount_.rig_from_viewer, viewer.space_from_viewer);
}

XrViewStateFlags XrDisplay::locate_eyes(XrSpace space) {
  XrViewLocateInfo info = {XR_TYPE_VIEW_LOCATE_INFO};
  info.viewConfigurationType = kStereo;
  info.displayTime = display_time_;
  info.space = space;
  XrViewState state = {XR_TYPE_VIEW_STATE};
  std::uint32_t count = 0;
  located_.fill({XR_TYPE_VIEW});
  const XrResult located = xrLocateViews(session_, &info, &state, 2, &count, located_.data());
  located_in_ = space;
  return XR_FAILED(located) || count != 2 ? 0 : state.viewStateFlags;
}

bool XrDisplay::take_eyes(const Transform<World, Space>& world_from_space, EyeViews& views) const {
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const auto pose = transform_of<Space, Eye>(located_[eye].pose);
    if (!pose || !take_fov(located_[eye].fov, views.value[eye])) {
      return false;
    }
    views.value[eye].world_from_eye = world_from_space * *pose;
  }
  return true;
}

bool XrDisplay::locate_in_world(EyeViews& views) {
  constexpr XrViewStateFlags kTracked =
      XR_VIEW_STATE_ORIENTATION_TRACKED_BIT | XR_VIEW_STATE_POSITION_TRACKED_BIT;
  const XrViewStateFlags flags = locate_eyes(space());
  const bool elsewhere = mount_.placement == Placement::kElsewhere;
  if (elsewhere && (flags & kKnown) == XR_VIEW_STATE_ORIENTATION_VALID_BIT) {
    stand_still(located_);
  } else if ((flags & kKnown) != kKnown) {
    return false;
  }
  // A guessed position would put holograms beside the bone. With cameras elsewhere there is no
  // bone.
  if (!elsewhere && (flags & kTracked) != kTracked) {
    return false;
  }
  std::optional<Transform<World, Space>> world_from_space;
  {
    const MutexLock lock(mutex_);
    world_from_space = anchor_.world_from_space(display_time_);
  }
  return world_from_space && take_eyes(*world_from_space, views);
}

void XrDisplay::locate_gaze(EyeViews& views) const {
  const auto now = runtime()->now();
  const auto seen = now ? gaze_.locate(space(), display_time_, *now) : std::nullopt;
  const auto time = seen ? timestamp(seen->time) : std::nullopt;
  if (!time) {
    return;
  }
  std::optional<Transform<World, Space>> world_from_space;
  {
    const MutexLock lock(mutex_);
    world_from_space = anchor_.world_from_space(display_time_);
  }
  if (world_from_space) {
    const auto world_from_gaze = *world_from_space * seen->space_from_gaze;
    views.gaze = Gaze{Point<World>{world_from_gaze.translation()},
                      world_from_gaze * Direction<GazePose>{{0, 0, -1}}, *time};
  }
}

EyeViews XrDisplay::views() {
  lay_world(display_time_);
  EyeViews views;
  if (const auto display_time = timestamp(display_time_)) {
    views.time = *display_time;
  }
  if (locate_in_world(views)) {
    views.status = PoseStatus::kPredicted;
    locate_gaze(views);
  } else {
    views.on_head = (locate_eyes(viewer()) & kKnown) == kKnown && take_eyes({}, views);
  }
  return views;
}

}  // namespace orthonav::openxr
