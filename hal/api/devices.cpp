#include "hal/api/devices.h"

#include <cmath>
#include <string>

namespace orthonav {

namespace {

Status check_images(const char* what, const StereoFrame& frame,
                    const StereoCalibration& calibration) {
  const auto check = [what](const char* which, const GreyImage& image, const CameraModel& camera) {
    return check_size(what, which, image, camera.width_px(), camera.height_px());
  };
  if (Status s = check("left", frame.left, calibration.left); !s) {
    return s;
  }
  return check("right", frame.right, calibration.right);
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

/// The contract of every stream of events: in order, and not later than requested.
Status check_time(const std::string& what, Timestamp time, Timestamp until,
                  std::optional<Timestamp> last) {
  if (last && time < *last) {
    return Error{what + " at " + in_seconds(time) + " comes before the one at " +
                 in_seconds(*last)};
  }
  if (time > until) {
    return Error{what + " at " + in_seconds(time) + " lies past the time asked for, " +
                 in_seconds(until)};
  }
  return {};
}

/// Why an event is not allowed now; null if it is.
const char* problem_of(ClickerAction action, const ButtonState& button) {
  switch (action) {
    case ClickerAction::kPress:
      return button.pressed ? "while the button is already pressed" : nullptr;
    case ClickerAction::kRelease:
      return button.pressed ? nullptr : "without a press";
    case ClickerAction::kClick:
      return button.clickable ? nullptr : "does not follow its release";
    case ClickerAction::kDoubleClick:
      if (!button.after_click) {
        return "does not follow a click";
      }
      return button.clickable ? nullptr : "does not follow its release";
    case ClickerAction::kHold:
      return button.pressed ? nullptr : "while the button is not pressed";
  }
  return nullptr;
}

Status check_covariance(const char* what, const StereoFrame& frame) {
  if (!frame.head_covariance || is_sound(*frame.head_covariance)) {
    return {};
  }
  return Error{std::string(what) + ": covariance of the head's pose at " + in_seconds(frame.time) +
               " is not finite, or has a negative variance"};
}

}  // namespace

void StereoFrame::clear() {
  left.clear();
  right.clear();
  sequence = -1;
  world_from_rig.reset();
  head_covariance.reset();
}

Result<Next> StereoCamera::next(StereoFrame& frame) {
  constexpr const char* kWhat = "camera pair";
  frame.repeats.reset();
  auto answer = order_.next(
      kWhat, frame, [&] { return do_next(frame); },
      [&] {
        const Status good = check_images(kWhat, frame, calibration());
        return good ? check_covariance(kWhat, frame) : good;
      });
  if (!answer || *answer != Next::kFrame) {
    return answer;
  }
  const auto repeats =
      repeats_.look(frame.left, frame.right, frame.world_from_rig, may_repeat(), frame.repeats);
  frame.repeats = repeats;
  if (!repeats) {
    return answer;
  }
  const Error old{std::string(kWhat) + " at " + in_seconds(frame.time) + ": " + text_of(*repeats)};
  frame.clear();
  return old;
}

Tracked<Transform<World, Rig>> HeadTracker::world_from_rig(Timestamp at) const {
  const auto lost = [at] {
    Tracked<Transform<World, Rig>> nothing;
    nothing.time = at;
    return nothing;
  };
  const std::optional<Timestamp> newest = do_newest_measurement();
  if (newest && at > *newest + kMaxHeadPrediction) {
    return lost();
  }
  const Tracked<Transform<World, Rig>> answer = do_world_from_rig(at);
  if (answer.status == PoseStatus::kLost || answer.time != at || !is_rigid(answer.value)) {
    return lost();
  }
  for (const double entry : answer.covariance) {
    if (!std::isfinite(entry)) {
      return lost();
    }
  }
  return answer;
}

Status ButtonState::take(ClickerAction action) {
  if (const char* problem = problem_of(action, *this); problem) {
    return Error{std::string("clicker: ") + name_of(action) + " " + problem};
  }
  if (action == ClickerAction::kPress) {
    *this = {true, false, false, clicked};
  }
  if (action == ClickerAction::kRelease) {
    *this = {false, true, false, after_click};
  }
  if (action == ClickerAction::kClick) {
    *this = {false, false, true, false};
  }
  if (action == ClickerAction::kDoubleClick) {
    *this = {};
  }
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
    if (status) {
      status = state.take(events[i].action);
    }
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
  if (down == pressed_at_.has_value()) {
    return;
  }
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
  if (!pressed_at_ || held_ || now - *pressed_at_ <= hold_after) {
    return;
  }
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
    if (!status) {
      break;
    }
    if (phrase.text.empty()) {
      status = Error{"voice: phrase at " + in_seconds(phrase.time) + " is empty"};
    } else if (!(phrase.confidence >= 0.0 && phrase.confidence <= 1.0)) {
      status = Error{"voice: confidence of \"" + phrase.text + "\" is " +
                     std::to_string(phrase.confidence) + ", must lie in [0, 1]"};
    }
    last = phrase.time;
  }
  if (!status) {
    phrases.resize(before);
    return status;
  }
  last_time_ = last;
  return {};
}

}  // namespace orthonav
