#include "tests/support/openxr_runtime/double_state.h"

#include <cmath>

namespace orthonav::test {
namespace {

/// About the middle of a standing wearer, half a centimetre and half a degree.
XrPosef sway(XrTime time) {
  const double t = static_cast<double>(time % 1'000'000'000'000) * 1e-9;
  const float half = static_cast<float>(0.004 * std::sin(0.7 * t));
  XrPosef pose = {};
  pose.orientation = {0, std::sin(half), 0, std::cos(half)};
  pose.position = {static_cast<float>(0.005 * std::sin(1.1 * t)), 1.6f,
                   static_cast<float>(0.005 * std::cos(0.9 * t))};
  return pose;
}

XrVector3f rotated(const XrQuaternionf& q, const XrVector3f& v) {
  const XrVector3f u = {q.x, q.y, q.z};
  const auto cross = [](const XrVector3f& a, const XrVector3f& b) {
    return XrVector3f{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  XrVector3f t = cross(u, v);
  t = {2 * t.x, 2 * t.y, 2 * t.z};
  const XrVector3f s = cross(u, t);
  return {v.x + q.w * t.x + s.x, v.y + q.w * t.y + s.y, v.z + q.w * t.z + s.z};
}

}  // namespace

Double& the_double() {
  static Double runtime;
  return runtime;
}

XrPosef multiplied(const XrPosef& a, const XrPosef& b) {
  const XrQuaternionf& p = a.orientation;
  const XrQuaternionf& q = b.orientation;
  XrPosef out;
  out.orientation = {
      p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y, p.w * q.y - p.x * q.z + p.y * q.w + p.z * q.x,
      p.w * q.z + p.x * q.y - p.y * q.x + p.z * q.w, p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z};
  const XrVector3f t = rotated(p, b.position);
  out.position = {a.position.x + t.x, a.position.y + t.y, a.position.z + t.z};
  return out;
}

XrPosef inverse(const XrPosef& pose) {
  const XrQuaternionf& q = pose.orientation;
  XrPosef out;
  out.orientation = {-q.x, -q.y, -q.z, q.w};
  const XrVector3f t = rotated(out.orientation, pose.position);
  out.position = {-t.x, -t.y, -t.z};
  return out;
}

void Double::reset(const RuntimeTraits& given) {
  const std::lock_guard lock(mutex);
  traits = given;
  head = sway;
  instance_lost = false;
  refusals = 0;
  events.clear();
  moves.clear();
  waited_frames = ended = 0;
  kept.clear();
  actions.clear();
  failing = {};
  pressed = synced_pressed = synced_controller = false;
  hands = synced_hands = {};
  gaze = synced_gaze = {};
  skipped = 0;
  wrong.clear();
  session_count = instance_count = 0;
}

void Double::set_head(std::function<XrPosef(XrTime)> given) {
  const std::lock_guard lock(mutex);
  head = std::move(given);
}

void Double::set_tracked(bool valid, bool position_tracked) {
  const std::lock_guard lock(mutex);
  traits.valid = valid;
  traits.position_tracked = position_tracked;
}

void Double::press(bool down) {
  const std::lock_guard lock(mutex);
  pressed = down;
  pressed_at = now();
}

void Double::set_controller(bool there) {
  const std::lock_guard lock(mutex);
  traits.controller = there;
}

void Double::set_hand(std::size_t hand, const HandState& state) {
  const std::lock_guard lock(mutex);
  hands[hand] = state;
}

void Double::set_gaze(const GazeState& state) {
  const std::lock_guard lock(mutex);
  gaze = state;
}

void Double::skip(int periods) {
  const std::lock_guard lock(mutex);
  skipped = periods;
}

void Double::tell(XrSessionState state) {
  const std::lock_guard lock(mutex);
  if (session) {
    enter(*session, state);
  }
}

void Double::enter(DoubleSession& of, XrSessionState state) {
  of.state = state;
  XrEventDataSessionStateChanged change = {XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED};
  change.session = reinterpret_cast<XrSession>(&of);
  change.state = state;
  change.time = now();
  events.emplace_back();
  *reinterpret_cast<XrEventDataSessionStateChanged*>(&events.back()) = change;
}

void Double::recentre(const XrPosef& old_from_new, bool known, int frames_ahead) {
  const std::lock_guard lock(mutex);
  const XrTime from = now() + frames_ahead * traits.period_ns;
  moves.push_back({from, old_from_new});
  XrEventDataReferenceSpaceChangePending change = {
      XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING};
  change.session = reinterpret_cast<XrSession>(session.get());
  change.changeTime = from;
  change.poseValid = known ? XR_TRUE : XR_FALSE;
  change.poseInPreviousSpace = old_from_new;
  for (const XrReferenceSpaceType type : traits.spaces) {
    if (type == XR_REFERENCE_SPACE_TYPE_VIEW) {
      continue;
    }
    change.referenceSpaceType = type;
    events.emplace_back();
    *reinterpret_cast<XrEventDataReferenceSpaceChangePending*>(&events.back()) = change;
  }
}

void Double::lose_session(bool announced) {
  const std::lock_guard lock(mutex);
  if (!session) {
    return;
  }
  if (announced) {
    enter(*session, XR_SESSION_STATE_LOSS_PENDING);
  } else {
    session->lost = true;
  }
}

void Double::lose_instance(bool announced) {
  const std::lock_guard lock(mutex);
  if (!announced) {
    instance_lost = true;
    return;
  }
  XrEventDataInstanceLossPending pending = {XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING};
  pending.lossTime = now() + 10 * traits.period_ns;
  events.emplace_back();
  *reinterpret_cast<XrEventDataInstanceLossPending*>(&events.back()) = pending;
}

void Double::stay_away(int attempts) {
  const std::lock_guard lock(mutex);
  refusals = attempts;
}

void Double::at_frame(std::int64_t number, std::function<void()> action) {
  const std::lock_guard lock(mutex);
  actions[number] = std::move(action);
}

void Double::fail_of_panel(const std::string& call, XrResult result, int times) {
  const std::lock_guard lock(mutex);
  failing = {call, result, times};
}

XrResult Double::fails(const char* call, bool of_panel) {
  if (!of_panel || failing.times == 0 || failing.call != call) {
    return XR_SUCCESS;
  }
  --failing.times;
  return failing.result;
}

std::int64_t Double::ended_frames() const {
  const std::lock_guard lock(mutex);
  return ended;
}

std::vector<SubmittedFrame> Double::frames() const {
  const std::lock_guard lock(mutex);
  return {kept.begin(), kept.end()};
}

int Double::sessions() const {
  const std::lock_guard lock(mutex);
  return session_count;
}

int Double::instances() const {
  const std::lock_guard lock(mutex);
  return instance_count;
}

std::vector<std::string> Double::violations() const {
  const std::lock_guard lock(mutex);
  return wrong;
}

XrResult Double::violated(const std::string& what, XrResult result) {
  if (wrong.size() < 100) {
    wrong.push_back(what);
  }
  return result;
}

XrTime Double::now() const {
  if (traits.stepped) {
    return stepped_now;
  }
  timespec time = {};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  // Far from CLOCK_MONOTONIC, so that confusing the two is noticed.
  return 3'000'000'000'000'000 + time.tv_sec * 1'000'000'000 + time.tv_nsec;
}

bool Double::is_session(XrSession handle) const {
  return session && handle == reinterpret_cast<XrSession>(session.get());
}

XrResult Double::alive() const {
  if (instance_lost) {
    return XR_ERROR_INSTANCE_LOST;
  }
  if (!session) {
    return XR_ERROR_HANDLE_INVALID;
  }
  return session->lost ? XR_ERROR_SESSION_LOST : XR_SUCCESS;
}

XrPosef Double::viewer_at(XrTime time) const {
  XrPosef pose = head(time);
  for (const SpaceMove& move : moves) {
    if (move.from <= time) {
      pose = multiplied(inverse(move.old_from_new), pose);
    }
  }
  return pose;
}

XrSpaceLocationFlags Double::flags() const {
  if (!traits.valid) {
    return 0;
  }
  if (!traits.position_known) {
    return XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  }
  XrSpaceLocationFlags flags = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT |
                               XR_SPACE_LOCATION_POSITION_VALID_BIT |
                               XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
  if (traits.position_tracked) {
    flags |= XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
  }
  return flags;
}

}  // namespace orthonav::test

extern "C" orthonav::test::RuntimeDouble* orthonav_runtime_double() {
  return &orthonav::test::the_double();
}
