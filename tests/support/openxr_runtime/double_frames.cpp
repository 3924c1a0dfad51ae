#include <algorithm>
#include <thread>
#include <utility>

#include "tests/support/openxr_runtime/double_state.h"

namespace orthonav::test {
namespace {

XrResult XRAPI_CALL wait_frame(XrSession, const XrFrameWaitInfo*, XrFrameState* state) {
  Double& d = the_double();
  std::int64_t pause_ns = 0;
  {
    const std::lock_guard lock(d.mutex);
    if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
      return dead;
    }
    DoubleSession& session = *d.session;
    if (!session.running) {
      return d.violated("a frame of no session", XR_ERROR_SESSION_NOT_RUNNING);
    }
    if (session.waited) {
      return d.violated("waited twice for a frame", XR_ERROR_CALL_ORDER_INVALID);
    }
    session.waited = true;
    const int periods = 1 + std::exchange(d.skipped, 0);
    if (d.traits.stepped) {
      d.stepped_now += periods * d.traits.period_ns;
    }
    const XrTime now = d.now();
    const XrTime next = (now / d.traits.period_ns + 1) * d.traits.period_ns;
    if (!d.traits.stepped) {
      pause_ns = next - now;
    }
    session.predicted = next + 2 * d.traits.period_ns;
    session.should_render =
        d.waited_frames++ >= d.traits.frames_without_render &&
        (session.state == XR_SESSION_STATE_VISIBLE || session.state == XR_SESSION_STATE_FOCUSED);
    state->predictedDisplayTime = session.predicted;
    state->predictedDisplayPeriod = d.traits.period_ns;
    state->shouldRender = session.should_render ? XR_TRUE : XR_FALSE;
  }
  if (pause_ns > 0) {
    std::this_thread::sleep_for(std::chrono::nanoseconds(pause_ns));
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL begin_frame(XrSession, const XrFrameBeginInfo*) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  DoubleSession& session = *d.session;
  if (!session.running) {
    return d.violated("a frame of no session", XR_ERROR_SESSION_NOT_RUNNING);
  }
  if (!session.waited) {
    return d.violated("a frame begun that was not waited for", XR_ERROR_CALL_ORDER_INVALID);
  }
  const bool discarded = session.begun;
  if (discarded) {
    d.violated("a frame begun before the last was ended", XR_SUCCESS);
  }
  session.waited = false;
  session.begun = true;
  return discarded ? XR_FRAME_DISCARDED : XR_SUCCESS;
}

/// What is wrong with the order or the values of a call, apart from its layers.
XrResult check_end(Double& d, const XrFrameEndInfo& info) {
  const DoubleSession& session = *d.session;
  if (!session.begun) {
    return d.violated("a frame ended that was not begun", XR_ERROR_CALL_ORDER_INVALID);
  }
  if (info.displayTime != session.predicted) {
    d.violated("a frame ended for another time", XR_SUCCESS);
  }
  const auto& blends = d.traits.blends;
  if (std::find(blends.begin(), blends.end(), info.environmentBlendMode) == blends.end()) {
    return d.violated("a blend mode that was not offered",
                      XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED);
  }
  if (!session.should_render && info.layerCount > 0) {
    d.violated("drawn where nothing is to be drawn", XR_SUCCESS);
  }
  return XR_SUCCESS;
}

/// Ends the frame and keeps what was submitted with it.
XrResult take_frame(Double& d, const XrFrameEndInfo& info) {
  d.session->begun = false;
  if (const XrResult failed = d.fails("xrEndFrame", info.layerCount > 1); failed != XR_SUCCESS) {
    ++d.ended;
    return failed;
  }
  SubmittedFrame frame;
  frame.number = d.ended++;
  frame.display_time = info.displayTime;
  frame.should_render = d.session->should_render;
  frame.layers = info.layerCount;
  frame.blend = info.environmentBlendMode;
  if (const XrResult taken = take_layers(d, info, frame); taken != XR_SUCCESS) {
    return taken;
  }
  d.kept.push_back(std::move(frame));
  while (d.kept.size() > std::max<std::size_t>(d.traits.frames_kept, 1)) {
    d.kept.pop_front();
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL end_frame(XrSession, const XrFrameEndInfo* info) {
  Double& d = the_double();
  std::function<void()> action;
  {
    const std::lock_guard lock(d.mutex);
    XrResult ended = d.alive();
    if (ended == XR_SUCCESS) {
      ended = check_end(d, *info);
    }
    if (ended == XR_SUCCESS) {
      ended = take_frame(d, *info);
    }
    if (ended != XR_SUCCESS) {
      return ended;
    }
    const auto found = d.actions.find(d.ended - 1);
    if (found != d.actions.end()) {
      action = found->second;
    }
  }
  if (action) {
    action();
  }
  return XR_SUCCESS;
}

}  // namespace

void add_frame_functions(std::map<std::string, PFN_xrVoidFunction>& table) {
  table["xrWaitFrame"] = as_void(wait_frame);
  table["xrBeginFrame"] = as_void(begin_frame);
  table["xrEndFrame"] = as_void(end_frame);
}

}  // namespace orthonav::test
