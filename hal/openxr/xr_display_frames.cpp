#include <algorithm>
#include <array>
#include <limits>

#include "hal/openxr/xr_display.h"
#include "hal/openxr/xr_error.h"

namespace orthonav::openxr {
namespace {

template <class Event>
const Event& as(const XrEventDataBuffer& event) {
  return reinterpret_cast<const Event&>(event);
}

DisplayFrame over(const char* why) {
  DisplayFrame turn;
  turn.kind = DisplayFrame::Kind::kOver;
  turn.why = why;
  return turn;
}

constexpr XrViewStateFlags kKnown =
    XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;

/// Eyes of a head whose place is not known, beside the origin as far as eyes are apart.
void stand_still(std::array<XrView, 2>& views) {
  constexpr double kHalfApart_m = 0.0315;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    XrPosef& pose = views[eye].pose;
    pose.position = {};
    const auto turned = transform_of<Space, Eye>(pose);
    if (!turned) {
      continue;
    }
    const Vec3 at = (*turned * Direction<Eye>{{eye == 0 ? -kHalfApart_m : kHalfApart_m, 0, 0}}).v;
    pose.position = {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
  }
}

}  // namespace

DisplayFrame XrDisplay::lost(const std::string& what, XrResult result) {
  instance_lost_ = instance_lost_ || result == XR_ERROR_INSTANCE_LOST;
  DisplayFrame turn;
  turn.kind = DisplayFrame::Kind::kLost;
  turn.why = error_of(what, result).message;
  return turn;
}

std::optional<DisplayFrame> XrDisplay::take_state(XrSessionState state) {
  switch (state_.take(state)) {
    case SessionDuty::kNone:
      return std::nullopt;
    case SessionDuty::kBegin: {
      XrSessionBeginInfo info = {XR_TYPE_SESSION_BEGIN_INFO};
      info.primaryViewConfigurationType = kStereo;
      const XrResult begun = xrBeginSession(session_, &info);
      if (XR_FAILED(begun)) {
        return lost("begin the session", begun);
      }
      if (end_asked_) {
        xrRequestExitSession(session_);
      }
      return std::nullopt;
    }
    case SessionDuty::kEnd: {
      const XrResult ended = xrEndSession(session_);
      if (XR_FAILED(ended)) {
        return lost("end the session", ended);
      }
      return std::nullopt;
    }
    case SessionDuty::kRestart:
      return lost("the session", XR_ERROR_SESSION_LOST);
    case SessionDuty::kLeave:
      return over("openxr: the session was ended from outside");
  }
  return std::nullopt;
}

/// World moves with the space that it hangs on.
void XrDisplay::take_space_change(const XrEventDataReferenceSpaceChangePending& change) {
  if (change.session != session_ || change.referenceSpaceType != space_type_) {
    return;
  }
  std::optional<Transform<Space, Space>> old_from_new;
  if (change.poseValid == XR_TRUE) {
    if (const auto pose = transform_of<Space, Space>(change.poseInPreviousSpace)) {
      old_from_new = *pose;
    }
  }
  const MutexLock lock(mutex_);
  anchor_.move(change.changeTime, old_from_new);
}

std::optional<DisplayFrame> XrDisplay::take_events() {
  for (;;) {
    XrEventDataBuffer event = {XR_TYPE_EVENT_DATA_BUFFER};
    const XrResult polled = xrPollEvent(runtime()->instance(), &event);
    if (polled == XR_EVENT_UNAVAILABLE) {
      return std::nullopt;
    }
    if (XR_FAILED(polled)) {
      return lost("ask for events", polled);
    }
    switch (event.type) {
      case XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED: {
        const auto& change = as<XrEventDataSessionStateChanged>(event);
        if (change.session != session_) {
          break;
        }
        if (auto turn = take_state(change.state)) {
          return turn;
        }
        break;
      }
      case XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING:
        return lost("the runtime", XR_ERROR_INSTANCE_LOST);
      case XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING:
        take_space_change(as<XrEventDataReferenceSpaceChangePending>(event));
        break;
      default:
        break;
    }
  }
}

void XrDisplay::poll_button() {
  const auto now = runtime()->now();
  if (!now) {
    return;
  }
  std::optional<SelectButton::Change> change;
  if (state_.focused()) {
    const auto polled = button_.poll(session_, *now);
    if (polled) {
      change = *polled;
    }
  } else {
    change = button_.let_go(*now);
  }
  if (!change) {
    return;
  }
  const auto time = timestamp(change->time);
  const MutexLock lock(mutex_);
  if (time) {
    button_changes_.push_back({change->down, *time});
  }
}

DisplayFrame XrDisplay::begin_frame() {
  if (auto ended = take_events()) {
    return *ended;
  }
  if (!state_.running()) {
    // Nobody will ever end a session that was not begun.
    return end_asked_ ? over("openxr: ended") : DisplayFrame{};
  }
  poll_button();
  return wait_and_begin();
}

DisplayFrame XrDisplay::wait_and_begin() {
  const XrFrameWaitInfo wait = {XR_TYPE_FRAME_WAIT_INFO};
  XrFrameState frame = {XR_TYPE_FRAME_STATE};
  const XrResult waited = xrWaitFrame(session_, &wait, &frame);
  if (XR_FAILED(waited)) {
    return lost("wait for a frame", waited);
  }
  const XrFrameBeginInfo begin = {XR_TYPE_FRAME_BEGIN_INFO};
  const XrResult begun = xrBeginFrame(session_, &begin);
  if (XR_FAILED(begun)) {
    return lost("begin a frame", begun);
  }
  display_time_ = frame.predictedDisplayTime;
  DisplayFrame turn;
  turn.kind = DisplayFrame::Kind::kFrame;
  const auto light = timestamp(display_time_);
  turn.draw = frame.shouldRender == XR_TRUE && light.has_value();
  if (light) {
    turn.display_time = *light;
    latency_ = std::max(Duration::zero(), *light - clock_.now());
  }
  return turn;
}

Result<std::vector<std::uint32_t>> XrDisplay::acquire() {
  std::vector<std::uint32_t> indices;
  const XrResult acquired = swapchains_.acquire(indices);
  if (acquired != XR_SUCCESS && acquired != XR_SESSION_LOSS_PENDING) {
    return error_of("acquire an image", acquired);
  }
  return indices;
}

/// Where World is still open, it is laid as soon as both heads are known.
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
  // A position that is guessed puts holograms beside the bone. Nothing hangs on a bone elsewhere.
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

EyeViews XrDisplay::views() {
  lay_world(display_time_);
  EyeViews views;
  if (const auto light = timestamp(display_time_)) {
    views.time = *light;
  }
  if (locate_in_world(views)) {
    views.status = PoseStatus::kPredicted;
  } else {
    views.on_head = (locate_eyes(viewer()) & kKnown) == kKnown && take_eyes({}, views);
  }
  return views;
}

Status XrDisplay::end_frame(bool drawn) {
  const XrResult released = swapchains_.release();
  std::array<XrCompositionLayerProjectionView, 2> eyes = {};
  std::array<XrCompositionLayerDepthInfoKHR, 2> depths = {};
  for (std::size_t eye = 0; drawn && eye < 2; ++eye) {
    eyes[eye].type = XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW;
    eyes[eye].pose = located_[eye].pose;
    eyes[eye].fov = located_[eye].fov;
    eyes[eye].subImage = swapchains_.part_of(eye);
    if (!swapchains_.has_depth()) {
      continue;
    }
    depths[eye].type = XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR;
    depths[eye].subImage = swapchains_.depth_of(eye);
    depths[eye].maxDepth = 1.0f;
    depths[eye].nearZ = static_cast<float>(near_m_);
    depths[eye].farZ = std::numeric_limits<float>::infinity();
    eyes[eye].next = &depths[eye];
  }
  XrCompositionLayerProjection layer = {XR_TYPE_COMPOSITION_LAYER_PROJECTION};
  // What we write is premultiplied; where nothing is drawn, the world is seen.
  if (setup_.blend == XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND) {
    layer.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
  }
  layer.space = located_in_;
  layer.viewCount = 2;
  layer.views = eyes.data();
  const auto* base = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer);
  XrFrameEndInfo end = {XR_TYPE_FRAME_END_INFO};
  end.displayTime = display_time_;
  end.environmentBlendMode = setup_.blend;
  end.layerCount = drawn && XR_SUCCEEDED(released) ? 1 : 0;
  end.layers = &base;
  const XrResult ended = xrEndFrame(session_, &end);
  if (XR_FAILED(released)) {
    return error_of("release an image", released);
  }
  return status_of("end a frame", ended);
}

}  // namespace orthonav::openxr
