#include <algorithm>
#include <array>
#include <limits>
#include <utility>

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
      display_time_ = 0;
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

std::optional<SelectButton::Change> XrDisplay::poll_focused(XrTime now) {
  const XrResult synced = actions_.sync(session_);
  if (synced == XR_SESSION_NOT_FOCUSED) {
    return button_.let_go(now);
  }
  const auto polled = XR_SUCCEEDED(synced)
                          ? button_.poll(actions_, {joints_, viewer()}, session_, now)
                          : Result<std::optional<SelectButton::Change>>(std::nullopt);
  return polled ? *polled : std::nullopt;
}

void XrDisplay::poll_button() {
  const auto now = runtime()->now();
  if (!now) {
    return;
  }
  std::optional<SelectButton::Change> change;
  if (state_.focused()) {
    change = poll_focused(*now);
  } else {
    change = button_.let_go(*now);
  }
  if (!change) {
    return;
  }
  const auto time = timestamp(change->time);
  const MutexLock lock(mutex_);
  if (time) {
    button_changes_.push_back({change->down, *time, change->lost});
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
  DisplayFrame frame;
  frame.kind = DisplayFrame::Kind::kFrame;
  take_timing(state, frame);
  return frame;
}

void XrDisplay::take_timing(const XrFrameState& state, DisplayFrame& frame) {
  const XrTime before = std::exchange(display_time_, state.predictedDisplayTime);
  const XrDuration period = state.predictedDisplayPeriod;
  frame.period = Duration(period);
  if (before > 0 && period > 0) {
    frame.missed = std::max<XrDuration>(0, (display_time_ - before + period / 2) / period - 1);
  }
  const auto display_time = timestamp(display_time_);
  frame.draw = state.shouldRender == XR_TRUE && display_time.has_value();
  if (display_time) {
    frame.display_time = *display_time;
    frame.ahead = *display_time - clock_.now();
    latency_ = std::max(Duration::zero(), frame.ahead);
  }
}

Result<std::vector<std::uint32_t>> XrDisplay::acquire() {
  std::vector<std::uint32_t> indices;
  const XrResult acquired = swapchains_.acquire(indices);
  if (acquired != XR_SUCCESS && acquired != XR_SESSION_LOSS_PENDING) {
    return error_of("acquire an image", acquired);
  }
  return indices;
}

XrCompositionLayerProjection XrDisplay::eyes_layer() {
  for (std::size_t eye = 0; eye < 2; ++eye) {
    eyes_[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
    eyes_[eye].pose = located_[eye].pose;
    eyes_[eye].fov = located_[eye].fov;
    eyes_[eye].subImage = swapchains_.part_of(eye);
    if (!swapchains_.has_depth()) {
      continue;
    }
    depths_[eye] = {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR};
    depths_[eye].subImage = swapchains_.depth_of(eye);
    depths_[eye].maxDepth = 1.0f;
    depths_[eye].nearZ = static_cast<float>(near_m_);
    depths_[eye].farZ = std::numeric_limits<float>::infinity();
    eyes_[eye].next = &depths_[eye];
  }
  XrCompositionLayerProjection layer = {XR_TYPE_COMPOSITION_LAYER_PROJECTION};
  // The images are premultiplied; the world shows where nothing is drawn.
  if (setup_.blend == XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND) {
    layer.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
  }
  layer.space = located_in_;
  layer.viewCount = 2;
  layer.views = eyes_.data();
  return layer;
}

Status XrDisplay::end_frame(const SubmittedContent& content) {
  const XrResult released = swapchains_.release();
  XrCompositionLayerProjection eyes = {XR_TYPE_COMPOSITION_LAYER_PROJECTION};
  XrCompositionLayerQuad panel = {XR_TYPE_COMPOSITION_LAYER_QUAD};
  std::array<const XrCompositionLayerBaseHeader*, 2> layers = {};
  XrFrameEndInfo end = {XR_TYPE_FRAME_END_INFO};
  if (content.eyes && XR_SUCCEEDED(released)) {
    eyes = eyes_layer();
    layers[end.layerCount++] = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&eyes);
  }
  // Later layers lie over earlier ones.
  const bool with_panel = content.panel && panel_.shows();
  if (with_panel) {
    panel = panel_.layer(*content.panel, viewer());
    layers[end.layerCount++] = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&panel);
  }
  end.displayTime = display_time_;
  end.environmentBlendMode = setup_.blend;
  end.layers = layers.data();
  const XrResult ended = xrEndFrame(session_, &end);
  if (XR_FAILED(ended) && with_panel) {
    panel_.give_up();
  }
  if (XR_FAILED(released)) {
    return error_of("release an image", released);
  }
  return status_of("end a frame", ended);
}

}  // namespace orthonav::openxr
