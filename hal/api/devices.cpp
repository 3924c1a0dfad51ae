#include "hal/api/devices.h"

#include <cmath>
#include <string>

namespace orthonav {

namespace {

// A pose that a device publishes is a rotation to rounding: `checked` makes it one.
constexpr double kMaxPoseDeviation = Transform<World, Rig>::kExact;

std::string in_seconds(Timestamp t) { return std::to_string(seconds(t.time_since_epoch())) + " s"; }

std::string size_text(int width_px, int height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

bool is_rigid(const Transform<World, Rig>& pose) {
  return pose.translation().is_finite() && pose.rotation().determinant() > 0.0 &&
         orthonormality_error(pose.rotation()) <= kMaxPoseDeviation;
}

Status check_image(const char* which, const GreyImage& image, const CameraModel& camera) {
  const bool right_size =
      image.width_px == camera.width_px() && image.height_px == camera.height_px();
  if (!right_size)
    return Error{std::string("camera pair: ") + which + " image is " +
                 size_text(image.width_px, image.height_px) + " px, its calibration " +
                 size_text(camera.width_px(), camera.height_px()) + " px"};
  const std::size_t expected = static_cast<std::size_t>(image.width_px) * image.height_px;
  if (image.pixels.size() != expected)
    return Error{std::string("camera pair: ") + which + " image holds " +
                 std::to_string(image.pixels.size()) + " bytes, must be " +
                 std::to_string(expected)};
  return {};
}

Status check_frame(const StereoFrame& frame, const StereoCalibration& calibration,
                   std::optional<Timestamp> last_time, std::int64_t last_sequence,
                   std::int64_t last_map_epoch) {
  if (last_time && frame.time <= *last_time)
    return Error{"camera pair: time " + in_seconds(frame.time) + " does not come after " +
                 in_seconds(*last_time)};
  if (frame.sequence <= last_sequence)
    return Error{"camera pair: sequence number " + std::to_string(frame.sequence) +
                 " does not come after " + std::to_string(last_sequence)};
  if (frame.map_epoch < last_map_epoch)
    return Error{"camera pair: map epoch " + std::to_string(frame.map_epoch) + " comes after " +
                 std::to_string(last_map_epoch)};
  if (auto status = check_image("left", frame.left, calibration.left); !status) return status;
  if (auto status = check_image("right", frame.right, calibration.right); !status) return status;
  if (frame.world_from_rig && !is_rigid(*frame.world_from_rig))
    return Error{"camera pair: head pose at " + in_seconds(frame.time) + " is not a rigid motion"};
  return {};
}

/// Keeps the buffers, so that the next frame allocates nothing.
void empty(StereoFrame& frame) {
  for (GreyImage* image : {&frame.left, &frame.right}) {
    image->width_px = 0;
    image->height_px = 0;
    image->pixels.clear();
  }
  frame.sequence = -1;
  frame.world_from_rig.reset();
}

const char* name_of(ClickerAction action) {
  switch (action) {
    case ClickerAction::kPress:
      return "press";
    case ClickerAction::kRelease:
      return "release";
    case ClickerAction::kClick:
      return "click";
    case ClickerAction::kDoubleClick:
      return "double click";
    case ClickerAction::kHold:
      return "hold";
  }
  return "unknown action";
}

/// What every stream of events keeps: in order, and not later than asked for.
Status check_time(const std::string& what, Timestamp time, Timestamp until,
                  std::optional<Timestamp> last) {
  if (last && time < *last)
    return Error{what + " at " + in_seconds(time) + " comes before the one at " +
                 in_seconds(*last)};
  if (time > until)
    return Error{what + " at " + in_seconds(time) + " lies past the time asked for, " +
                 in_seconds(until)};
  return {};
}

}  // namespace

Result<Next> StereoCamera::next(StereoFrame& frame) {
  if (ended_) return Next::kEnd;
  Result<Next> answer = do_next(frame);
  if (!answer) {
    empty(frame);
    return answer;
  }
  if (*answer == Next::kEnd) ended_ = true;
  if (*answer != Next::kFrame) return answer;
  if (Status status =
          check_frame(frame, calibration(), last_time_, last_sequence_, last_map_epoch_);
      !status) {
    empty(frame);
    return status.error();
  }
  last_time_ = frame.time;
  last_sequence_ = frame.sequence;
  last_map_epoch_ = frame.map_epoch;
  return answer;
}

Tracked<Transform<World, Rig>> HeadTracker::world_from_rig(Timestamp at) const {
  const auto lost = [at] {
    Tracked<Transform<World, Rig>> nothing;
    nothing.time = at;
    return nothing;
  };
  const std::optional<Timestamp> newest = do_newest_measurement();
  if (newest && at > *newest + kMaxHeadPrediction) return lost();
  const Tracked<Transform<World, Rig>> answer = do_world_from_rig(at);
  if (answer.origin == Origin::kLost || answer.time != at || !is_rigid(answer.value)) return lost();
  for (const double entry : answer.covariance)
    if (!std::isfinite(entry)) return lost();
  return answer;
}

Status ButtonState::take(ClickerAction action) {
  const char* refused = nullptr;
  switch (action) {
    case ClickerAction::kPress:
      if (pressed) refused = "while the button is already pressed";
      break;
    case ClickerAction::kRelease:
      if (!pressed) refused = "without a press";
      break;
    case ClickerAction::kClick:
      if (!clickable) refused = "does not follow its release";
      break;
    case ClickerAction::kDoubleClick:
      if (!clickable) refused = "does not follow its release";
      if (!after_click) refused = "does not follow a click";
      break;
    case ClickerAction::kHold:
      if (!pressed) refused = "while the button is not pressed";
      break;
  }
  if (refused) return Error{std::string("clicker: ") + name_of(action) + " " + refused};
  if (action == ClickerAction::kPress) *this = {true, false, false, clicked};
  if (action == ClickerAction::kRelease) *this = {false, true, false, after_click};
  if (action == ClickerAction::kClick) *this = {false, false, true, false};
  if (action == ClickerAction::kDoubleClick) *this = {};
  return {};
}

Status Clicker::poll(Timestamp until, std::vector<ClickerEvent>& events) {
  const std::size_t before = events.size();
  Status status = do_poll(until, events);
  auto last = last_time_;
  ButtonState state = state_;
  for (std::size_t i = before; i < events.size() && status.ok(); ++i) {
    const std::string what = std::string("clicker: ") + name_of(events[i].action);
    status = check_time(what, events[i].time, until, last);
    if (status) status = state.take(events[i].action);
    last = events[i].time;
  }
  if (!status) {
    events.resize(before);
    return status;
  }
  last_time_ = last;
  state_ = state;
  return {};
}

void ClickTimer::button(bool down, Timestamp time, std::vector<ClickerEvent>& events) {
  if (down == pressed_at_.has_value()) return;
  if (down) {
    pressed_at_ = time;
    held_ = false;
    events.push_back({ClickerAction::kPress, time});
    return;
  }
  advance(time, events);
  const Timestamp pressed = *pressed_at_;
  pressed_at_.reset();
  events.push_back({ClickerAction::kRelease, time});
  if (held_) {
    last_click_pressed_at_.reset();
  } else if (last_click_pressed_at_ && pressed - *last_click_pressed_at_ <= double_within) {
    last_click_pressed_at_.reset();
    events.push_back({ClickerAction::kDoubleClick, time});
  } else {
    last_click_pressed_at_ = pressed;
    events.push_back({ClickerAction::kClick, time});
  }
}

void ClickTimer::advance(Timestamp now, std::vector<ClickerEvent>& events) {
  if (!pressed_at_ || held_ || now - *pressed_at_ <= hold_after) return;
  held_ = true;
  events.push_back({ClickerAction::kHold, *pressed_at_ + hold_after});
}

Status Voice::poll(Timestamp until, std::vector<Phrase>& phrases) {
  const std::size_t before = phrases.size();
  Status status = do_poll(until, phrases);
  auto last = last_time_;
  for (std::size_t i = before; i < phrases.size() && status.ok(); ++i) {
    const Phrase& phrase = phrases[i];
    status = check_time("voice: phrase \"" + phrase.text + "\"", phrase.time, until, last);
    if (!status) break;
    if (phrase.text.empty())
      status = Error{"voice: phrase at " + in_seconds(phrase.time) + " is empty"};
    else if (!(phrase.confidence >= 0.0 && phrase.confidence <= 1.0))
      status = Error{"voice: confidence of \"" + phrase.text + "\" is " +
                     std::to_string(phrase.confidence) + ", must lie in [0, 1]"};
    last = phrase.time;
  }
  if (!status) {
    phrases.resize(before);
    return status;
  }
  last_time_ = last;
  return {};
}

Status Display::shown(const ShownFrame& frame) {
  if (frame.display_time <= last_display_time_)
    return Error{"display: frame for " + in_seconds(frame.display_time) +
                 " does not come after the one for " + in_seconds(last_display_time_)};
  if (Status status = do_shown(frame); !status) return status;
  last_display_time_ = frame.display_time;
  return {};
}

}  // namespace orthonav
