#include "hal/igtl/pose_frames.h"

#include <algorithm>
#include <utility>

namespace orthonav::igtl {
namespace {

constexpr std::size_t kMaxOthers = 16;

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Where "To" stands between two names: each begins with a capital or a number, unless `anyhow`.
std::vector<std::size_t> separators(const std::string& name, bool anyhow) {
  // Fewer letters are rather a part of a word: "motor".
  constexpr std::size_t kFewestLetters = 3;
  std::vector<std::size_t> found;
  for (std::size_t at = 1; at + 2 < name.size(); ++at) {
    const bool capital = name[at] == 'T' && name[at + 1] == 'o';
    const bool any = (name[at] == 'T' || name[at] == 't') &&
                     (name[at + 1] == 'O' || name[at + 1] == 'o') && at >= kFewestLetters &&
                     at + 2 + kFewestLetters <= name.size();
    if (anyhow ? any : capital && (is_upper(name[at + 2]) || is_digit(name[at + 2]))) {
      found.push_back(at);
    }
  }
  return found;
}

}  // namespace

Result<std::optional<NamedFrames>> frames_named(const std::string& transform) {
  auto at = separators(transform, false);
  if (at.empty()) {
    at = separators(transform, true);
  }
  if (at.empty()) {
    return std::optional<NamedFrames>();
  }
  if (at.size() > 1) {
    return Error{transform + " says \"To\" more than once, so its frame is unknown"};
  }
  return std::optional(NamedFrames{transform.substr(0, at[0]), transform.substr(at[0] + 2)});
}

PoseFrames::PoseFrames(PoseFramesOptions options)
    : options_(std::move(options)), told_(options_.tools.size()) {
  for (std::size_t i = 0; i < told_.size(); ++i) {
    const auto frames = frames_named(options_.tools[i].transform);
    told_[i].of = frames && *frames ? (*frames)->of : "";
  }
}

std::optional<std::size_t> PoseFrames::tool_of(const std::string& transform) {
  for (std::size_t i = 0; i < options_.tools.size(); ++i) {
    if (options_.tools[i].transform.substr(0, kNameBytes) == transform) {
      return i;
    }
  }
  const bool known = std::find(others_.begin(), others_.end(), transform) != others_.end();
  if (!known && others_.size() < kMaxOthers) {
    others_.push_back(transform);
  }
  return std::nullopt;
}

void PoseFrames::take(const SentPose& pose, Timestamp time, Timestamp now) {
  begun_ = begun_.value_or(now);
  const auto tool = tool_of(pose.name);
  if (!tool) {
    return look_for_tool_elsewhere(pose.name, now);
  }
  told_[*tool].heard_at = now;
  heard_at_ = now;
  const bool of_open = open_ && time >= *open_ - kOneMoment && time <= *open_ + kOneMoment;
  if (open_ && (!of_open || told_[*tool].now) && time > *open_) {
    close();
  }
  if (!open_) {
    if (last_ && time <= *last_) {
      ++out_of_order_;
      return;
    }
    open_ = time;
    opened_at_ = now;
  } else if (!of_open || told_[*tool].now) {
    ++out_of_order_;
    return;
  }
  note(*tool, pose, time);
  if (std::all_of(told_.begin(), told_.end(), [](const Told& each) { return each.now; })) {
    close();
  }
}

void PoseFrames::look_for_tool_elsewhere(const std::string& transform, Timestamp now) {
  for (std::size_t i = 0; i < told_.size(); ++i) {
    Told& told = told_[i];
    if (told.complained || told.of.empty() || !transform.starts_with(told.of) ||
        now - told.heard_at.value_or(*begun_) <= kSentOtherwise) {
      continue;
    }
    const auto frames = frames_named(transform);
    if (frames && *frames && (*frames)->of == told.of) {
      told.complained = true;
      complaint_ = options_.tools[i].tool + " comes as " + transform + ", in frame \"" +
                   (*frames)->in + "\", and not as " + options_.tools[i].transform +
                   ": it is not used; have it sent in the frame of the others";
    }
  }
}

std::optional<std::string> PoseFrames::take_complaint() {
  return std::exchange(complaint_, std::nullopt);
}

void PoseFrames::note(std::size_t tool, const SentPose& pose, Timestamp time) {
  Told& told = told_[tool];
  if (!told.ever || told.pose != pose.world_from_marker) {
    told.since = time;
  }
  told.ever = true;
  told.now = true;
  told.pose = pose.world_from_marker;
}

ToolPoses PoseFrames::empty_frame(Timestamp time) const {
  ToolPoses frame;
  frame.time = time;
  frame.tools.resize(told_.size());
  return frame;
}

void PoseFrames::close() {
  ToolPoses frame = empty_frame(*open_);
  for (std::size_t i = 0; i < told_.size(); ++i) {
    Told& told = told_[i];
    const bool frozen =
        options_.frozen_after > Duration::zero() && frame.time - told.since > options_.frozen_after;
    if (std::exchange(told.now, false) && told.pose && !frozen) {
      frame.tools[i] = {*told.pose, frame.time, PoseStatus::kMeasured, options_.covariance};
    }
  }
  open_.reset();
  last_ = frame.time;
  done_ = std::move(frame);
}

std::optional<ToolPoses> PoseFrames::next(Timestamp now) {
  if (open_ && now - opened_at_ >= kWaitForRest) {
    close();
  }
  if (!done_ && !open_ && now - heard_at_ > kNobodyInSight) {
    // Dated back, so that poses still in transit are not out of order.
    const Timestamp then = now - kNobodyInSight;
    heard_at_ = now;
    if (!last_ || then > *last_) {
      last_ = then;
      return empty_frame(then);
    }
  }
  return std::exchange(done_, std::nullopt);
}

void PoseFrames::forget() {
  open_.reset();
  done_.reset();
  for (Told& told : told_) {
    told.now = false;
    told.pose.reset();
    told.ever = false;
    told.heard_at.reset();
    told.complained = false;
  }
  begun_.reset();
}

std::size_t PoseFrames::heard() const {
  return static_cast<std::size_t>(
      std::count_if(told_.begin(), told_.end(), [](const Told& each) { return each.ever; }));
}

}  // namespace orthonav::igtl
