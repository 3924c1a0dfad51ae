#include "hal/hl2ss/scene_client.h"

#include <algorithm>
#include <utility>

namespace orthonav::hl2ss {
namespace {

using std::chrono::milliseconds;

constexpr Duration kShortestFrame = std::chrono::microseconds(16'667);
constexpr Duration kLongestFrame = milliseconds(100);
/// How much a single frame moves the estimate.
constexpr int kFrameSmoothing = 8;
/// Without an answer for this long, data sent may be delayed and shown late.
constexpr Duration kLongestUnanswered = milliseconds(250);
/// Longest age of the pair of unacknowledged guidance. Guidance in transit would be shown whenever
/// it arrives, even when old: TCP retransmits lost data much later.
constexpr Duration kLongestUnshown = milliseconds(200);
/// A sample may be longer than the previous one by this much.
constexpr Duration kRoundTripGrows = milliseconds(2);
constexpr Duration kKeepAliveEvery = std::chrono::seconds(1);
constexpr int kPatientRefusals = 3;
constexpr Duration kRefusalPause = std::chrono::seconds(1);
/// Commands without room wait until there is room for a few of them.
constexpr double kWorthwhileBytes = 500;
constexpr std::size_t kMostSamples = 100'000;

void note(std::vector<double>& samples, Duration took) {
  if (samples.size() < kMostSamples) {
    samples.push_back(seconds(took) * 1e3);
  }
}

}  // namespace

void SceneClient::connected(HostTime now) {
  expected_.clear();
  remotes_.clear();
  awaited_ = tool_answers_due_ = 0;
  is_clear_ = list_is_open_ = has_more_ = false;
  is_fresh_ = true;
  sent_tool_time_.reset();
  tool_due_.reset();
  sent_at_ = heard_at_ = now;
  ++statistics_.connections;
}

void SceneClient::want(const ObjectList& list) {
  wanted_ = list;
  is_fresh_ = true;
  ++list_number_;
}

std::vector<std::uint8_t> SceneClient::sent(std::vector<std::uint8_t> bytes, HostTime now) {
  sent_at_ = now;
  asks_alone_ = was_idle_;
  statistics_.bytes += static_cast<std::int64_t>(bytes.size());
  allowance_bytes_ -= static_cast<double>(bytes.size());
  return bytes;
}

void SceneClient::refill(HostTime now) {
  const double passed_s = seconds(std::chrono::duration_cast<Duration>(now - allowance_at_));
  allowance_bytes_ =
      std::min(budget_.burst_bytes, allowance_bytes_ + passed_s * budget_.bytes_a_second);
  allowance_at_ = now;
}

std::vector<std::uint8_t> SceneClient::next(const SceneMoment& now) {
  refill(now.host);
  was_idle_ = expected_.empty();
  if (awaited_ > 0) {
    return {};
  }
  if (!is_clear_ || epoch_ != wanted_.map_epoch) {
    return start_over(now.host);
  }
  if (!is_fresh_ && (!has_more_ || allowance_bytes_ < kWorthwhileBytes)) {
    return keep_alive(now.host);
  }
  const int fuse = fuse_frames(now);
  if (is_fresh_ && wanted_.tool_time && fuse == 0) {
    ++statistics_.withheld;
  }
  const Draft draft = draft_list(fuse > 0, now.host);
  is_fresh_ = false;
  if (draft.commands() == 0) {
    return keep_alive(now.host);
  }
  sent_tool_time_ = draft.tool_ids.empty() ? std::nullopt : wanted_.tool_time;
  if (sent_tool_time_) {
    tool_due_ = now.host + (kLongestUnshown - (now.headset - *sent_tool_time_));
  }
  return assemble(draft, fuse, now.host);
}

/// Removes all objects, with one command in one frame: they belong to a previous client or another
/// map.
std::vector<std::uint8_t> SceneClient::start_over(HostTime now) {
  std::vector<std::uint8_t> bytes;
  append_plain(bytes, SceneCommand::kRemoveAll);
  expected_.push_back({});
  if (std::exchange(list_is_open_, false)) {
    append_plain(bytes, SceneCommand::kEndList);
    expected_.push_back({});
  }
  awaited_ = expected_.size();
  remotes_.clear();
  is_clear_ = is_fresh_ = true;
  epoch_ = wanted_.map_epoch;
  ++statistics_.commands;
  return sent(std::move(bytes), now);
}

/// A suspended application does not close the connection. Only a missing answer reveals it, so a
/// command is sent once a second.
std::vector<std::uint8_t> SceneClient::keep_alive(HostTime now) {
  if (!expected_.empty() || now - sent_at_ < kKeepAliveEvery) {
    return {};
  }
  std::vector<std::uint8_t> bytes;
  if (std::exchange(list_is_open_, false)) {
    append_plain(bytes, SceneCommand::kEndList);
  } else {
    append_idle(bytes);
  }
  expected_.push_back({});
  awaited_ = 1;
  ++statistics_.commands;
  return sent(std::move(bytes), now);
}

Status SceneClient::answered(std::uint32_t answer, const SceneMoment& now) {
  if (expected_.empty()) {
    return Error{"scene: answer " + std::to_string(answer) + " to nothing"};
  }
  const Expected expected = expected_.front();
  expected_.pop_front();
  awaited_ -= awaited_ > 0 ? 1 : 0;
  tool_answers_due_ -= tool_answers_due_ > 0 ? 1 : 0;
  const auto since = std::chrono::duration_cast<Duration>(now.host - heard_at_);
  heard_at_ = now.host;
  note_round_trip(now.host);
  if (expected.kind == Expected::Kind::kIdle) {
    frame_ = std::clamp(frame_ + (since - frame_) / kFrameSmoothing, kShortestFrame, kLongestFrame);
  }
  if (expected.kind == Expected::Kind::kCreate) {
    return take_id(expected.key, answer, now.host);
  }
  if (expected.kind == Expected::Kind::kListEnd && answer == 1) {
    list_shown(now);
  }
  return take_done(expected, answer, now.host);
}

Status SceneClient::take_done(const Expected& expected, std::uint32_t answer, HostTime now) {
  if (answer > 1) {
    return Error{"scene: answer " + std::to_string(answer) + " to a command, must be 0 or 1"};
  }
  statistics_.refused += answer == 0 ? 1 : 0;
  if (expected.kind != Expected::Kind::kObject) {
    return {};
  }
  if (answer == 0) {
    refuse(expected.key, now);
  } else if (const auto found = remotes_.find(expected.key); found != remotes_.end()) {
    found->second.refusals = 0;
  }
  return {};
}

Status SceneClient::take_id(std::uint64_t key, std::uint32_t answer, HostTime now) {
  Remote& remote = remotes_[key];
  remote.creating = false;
  has_more_ = true;
  if (answer == 0) {
    ++statistics_.refused;
    refuse(key, now);
    return {};
  }
  for (const auto& [other_key, other] : remotes_) {
    if (other.id == answer) {
      return Error{"scene: id " + std::to_string(answer) + " is given to two objects"};
    }
  }
  remote.id = answer;
  return {};
}

/// Several commands for one object may be refused; it is requested again only once.
void SceneClient::refuse(std::uint64_t key, HostTime now) {
  const auto found = remotes_.find(key);
  if (found == remotes_.end()) {
    return;
  }
  Remote& remote = found->second;
  has_more_ = true;
  if (remote.refusals == 0 || remote.id != 0 || now >= remote.ask_again) {
    ++remote.refusals;
    remote.ask_again = remote.refusals > kPatientRefusals ? now + kRefusalPause : now;
  }
  remote.forget();
}

/// Frame timing lengthens samples at random: the shortest count, with slow forgetting.
void SceneClient::note_round_trip(HostTime now) {
  if (std::exchange(asks_alone_, false)) {
    const auto took = std::chrono::duration_cast<Duration>(now - sent_at_);
    round_trip_ = std::min(took, round_trip_ + kRoundTripGrows);
  }
}

void SceneClient::list_shown(const SceneMoment& now) {
  tool_due_.reset();
  note(statistics_.acknowledged_ms, std::chrono::duration_cast<Duration>(now.host - sent_at_));
  if (sent_tool_time_) {
    note(statistics_.shown_age_ms, now.headset - *sent_tool_time_);
  }
}

Status SceneClient::overdue(HostTime now) const {
  if (tool_due_ && now > *tool_due_) {
    return Error{"scene: guidance is not acknowledged " +
                 std::to_string(kLongestUnshown / milliseconds(1)) + " ms after its pair"};
  }
  const auto silent = std::chrono::duration_cast<Duration>(now - std::max(sent_at_, heard_at_));
  if (tool_answers_due_ == 0 || silent <= kLongestUnanswered) {
    return {};
  }
  return Error{"scene: no answer for " + std::to_string(silent / milliseconds(1)) +
               " ms while guidance is shown, limit " +
               std::to_string(kLongestUnanswered / milliseconds(1)) + " ms"};
}

std::vector<std::uint8_t> SceneClient::goodbye() {
  std::vector<std::uint8_t> bytes;
  append_plain(bytes, SceneCommand::kRemoveAll);
  return bytes;
}

ObjectDisplayStatistics SceneClient::statistics() const {
  ObjectDisplayStatistics all = statistics_;
  all.objects = std::count_if(remotes_.begin(), remotes_.end(),
                              [](const auto& each) { return each.second.id != 0; });
  return all;
}

}  // namespace orthonav::hl2ss
