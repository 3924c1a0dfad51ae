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
  DisplayFrame frame;
  frame.kind = DisplayFrame::Kind::kOver;
  frame.why = why;
  return frame;
}

}  // namespace

DisplayFrame XrDisplay::lost(const std::string& what, XrResult result) {
  instance_lost_ = instance_lost_ || result == XR_ERROR_INSTANCE_LOST;
  DisplayFrame frame;
  frame.kind = DisplayFrame::Kind::kLost;
  frame.why = error_of(what, result).message;
  return frame;
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

/// World moves with the runtime's space.
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
        if (auto ended = take_state(change.state)) {
          return ended;
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
    // A session that was never begun gets no event that ends it.
    return end_asked_ ? over("openxr: ended") : DisplayFrame{};
  }
  poll_button();
  return wait_and_begin();
}

DisplayFrame XrDisplay::wait_and_begin() {
  const XrFrameWaitInfo wait = {XR_TYPE_FRAME_WAIT_INFO};
  XrFrameState state = {XR_TYPE_FRAME_STATE};
  const XrResult waited = xrWaitFrame(session_, &wait, &state);
  if (XR_FAILED(waited)) {
    return lost("wait for a frame", waited);
  }
  const XrFrameBeginInfo begin = {XR_TYPE_FRAME_BEGIN_INFO};
  const XrResult begun = xrBeginFrame(session_, &begin);
  if (XR_FAILED(begun)) {
    return lost("begin a frame", begun);
  }
  display_time_ = state.predictedDisplayTime;
  DisplayFrame frame;
  frame.kind = DisplayFrame::Kind::kFrame;
  const auto display_time = timestamp(display_time_);
  frame.draw = state.shouldRender == XR_TRUE && display_time.has_value();
  if (display_time) {
    frame.display_time = *display_time;
    latency_ = std::max(Duration::zero(), *display_time - clock_.now());
  }
  return frame;
}

Result<std::vector<std::uint32_t>> XrDisplay::acquire() {
  std::vector<std::uint32_t> indices;
  const XrResult acquired = swapchains_.acquire(indices);
  if (acquired != XR_SUCCESS && acquired != XR_SESSION_LOSS_PENDING) {
    return error_of("acquire an image", acquired);
  }
  return indices;
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
  // The images are premultiplied; the world shows where nothing is drawn.
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
