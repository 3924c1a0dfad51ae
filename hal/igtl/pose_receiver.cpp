#include "hal/igtl/pose_receiver.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/guarded.h"
#include "base/joined.h"
#include "base/printed.h"
#include "hal/net/socket.h"

namespace orthonav::igtl {
namespace {

/// How often timed actions are checked.
constexpr int kTurn_ms = 5;
constexpr int kReadsATurn = 16;
constexpr std::size_t kMaxBytesPerSecond = std::size_t{32} << 20;
/// A connection that is made this much more slowly than the fastest one tells of a slow network, on
/// which messages are late indeed.
constexpr auto kSlower = std::chrono::milliseconds(50);
constexpr std::size_t kMaxToTell = 8;

}  // namespace

PoseReceiver::PoseReceiver(const net::Endpoint& host, const TrackerOptions& options)
    : options_(options),
      link_(host, options.port),
      frames_({options.tools, options.covariance(), options.frozen_after}) {
  stream_.name = "poses";
  thread_ = std::thread([this] {
    const Status died = guarded("igtl", [this] { run(); });
    if (!died) {
      const MutexLock lock(mutex_);
      died_ = died;
    }
  });
}

PoseReceiver::~PoseReceiver() {
  stop_ = true;
  wake_up_.wake();
  thread_.join();
}

void PoseReceiver::run() {
  while (!stop_) {
    std::array<pollfd, 2> watched = {{{wake_up_.fd(), POLLIN, 0}, {link_.fd(), link_.events(), 0}}};
    net::wait_for_news(watched, kTurn_ms);
    turn(watched[1].revents, HostClock::now());
  }
}

void PoseReceiver::turn(short revents, HostTime now) {
  const bool is_new = link_.step(revents, now) == net::Link::Step::kConnected;
  if (is_new) {
    begin_connection();
  }
  if (!link_.is_connected()) {
    tell();
    return;
  }
  if (!is_new && (revents & (POLLIN | POLLERR | POLLHUP)) != 0) {
    read_all(now);
  }
  if (link_.is_connected()) {
    if (const auto frame = frames_.next(clock_.now())) {
      publish(*frame);
    }
  }
  tell();
}

void PoseReceiver::begin_connection() {
  // A tracker sends nothing while all tools are out of sight: silence alone does not mean a lost
  // connection.
  net::keep_alive(link_.socket());
  incoming_ = Incoming(this);
  // What is known of the sender's clock shows that messages on a slow network are late.
  const HostClock::duration shortest = shortest_round_trip_.value_or(link_.round_trip());
  if (link_.round_trip() <= shortest + kSlower) {
    sender_.forget();
  }
  shortest_round_trip_ = std::min(shortest, link_.round_trip());
  frames_.forget();
  const MutexLock lock(mutex_);
  ++stream_.connections;
  // The tracker's frame may no longer be where it was before.
  map_epoch_ += std::exchange(was_connected_, true) ? 1 : 0;
}

void PoseReceiver::read_all(HostTime now) {
  std::array<std::uint8_t, 16384> room{};
  for (int i = 0; i < kReadsATurn; ++i) {
    const auto count = link_.receive(room);
    if (!count) {
      return lose(count.error().message, now);
    }
    if (*count == 0) {
      return;
    }
    arrived_ = clock_.now();
    Status taken = count_bytes(*count, now);
    taken = taken ? incoming_.take(std::span(room).first(*count)) : taken;
    if (!taken) {
      return lose(taken.error().message, now);
    }
  }
}

Status PoseReceiver::count_bytes(std::size_t count, HostTime now) {
  const MutexLock lock(mutex_);
  stream_.bytes += static_cast<std::int64_t>(count);
  if (bytes_.allows(count, kMaxBytesPerSecond, now)) {
    return {};
  }
  return Error{"sends more than " + std::to_string(kMaxBytesPerSecond) + " bytes a second"};
}

Status PoseReceiver::read(const Header& header, Bytes body) {
  const auto poses = poses_in(header, body);
  {
    const MutexLock lock(mutex_);
    ++stream_.packets;
    if (!poses) {
      ++stream_.damaged;
      stream_.last_trouble = poses.error().message;
    }
  }
  if (!poses) {
    return {};  // the stream continues after it
  }
  const Timestamp time = sender_.time_of(header.timestamp, arrived_, header.device);
  if (const auto step = sender_.take_step()) {
    complain("the sender's clock was set " +
             std::string(*step > Duration::zero() ? "forward" : "back") + " by " +
             printed("%.3f", std::abs(seconds(*step))) +
             " s: its poses were not used until it was known again");
    const MutexLock lock(mutex_);
    ++clock_steps_;
  }
  if (sender_.known()) {
    for (const SentPose& pose : *poses) {
      frames_.take(pose, time, arrived_);
    }
  }
  if (const auto complaint = frames_.take_complaint()) {
    complain(*complaint);
  }
  if (sender_.wants_new_connection()) {
    return Error{"poses come " + std::to_string(seconds(sender_.late())) + " s late"};
  }
  return {};
}

/// Told with the next call of `next`. What nobody asks for is not kept for ever.
void PoseReceiver::complain(const std::string& what) {
  const MutexLock lock(mutex_);
  stream_.last_trouble = what;
  if (to_tell_.size() < kMaxToTell) {
    to_tell_.push_back({"igtl: " + options_.host + ": " + what, ErrorCode::kUnavailable});
  }
}

void PoseReceiver::lose(const std::string& why, HostTime now) {
  link_.drop(why, now);
  const MutexLock lock(mutex_);
  waiting_.reset();
  stream_.last_trouble = why;
  to_tell_.assign(1, {"igtl: " + options_.host + ": connection lost: " + why, ErrorCode::kLost});
}

void PoseReceiver::publish(const ToolPoses& frame) {
  const MutexLock lock(mutex_);
  dropped_ += waiting_ ? 1 : 0;
  ++frames_out_;
  newest_ = frame.time;
  waiting_ = frame;
}

void PoseReceiver::tell() {
  const MutexLock lock(mutex_);
  stream_.out_of_order = frames_.out_of_order();
  heard_ = heard_ || frames_.heard() > 0;
  if (!link_.is_connected() && !link_.trouble().empty()) {
    stream_.last_trouble = link_.trouble();
  }
  if (!heard_) {
    others_ = joined(frames_.others(), ", ");
  }
}

Result<Next> PoseReceiver::next(ToolPoses& poses) {
  const MutexLock lock(mutex_);
  if (!died_) {
    return died_.error();
  }
  if (!to_tell_.empty()) {
    Error first = std::move(to_tell_.front());
    to_tell_.erase(to_tell_.begin());
    return first;
  }
  if (!waiting_) {
    return Next::kNone;
  }
  poses.sequence = ++sequence_;
  poses.map_epoch = map_epoch_;
  poses.time = waiting_->time;
  // The tracker's frame is World and does not move.
  poses.world_from_rig = Transform<World, Rig>{};
  poses.tools.assign(waiting_->tools.begin(), waiting_->tools.end());
  waiting_.reset();
  return Next::kFrame;
}

std::optional<Timestamp> PoseReceiver::newest() const {
  const MutexLock lock(mutex_);
  return newest_;
}

bool PoseReceiver::has_heard() const {
  const MutexLock lock(mutex_);
  return heard_;
}

std::string PoseReceiver::trouble() const {
  const MutexLock lock(mutex_);
  if (!stream_.last_trouble.empty()) {
    return stream_.last_trouble;
  }
  return others_.empty() ? "it sends none" : "it sends " + others_;
}

ConnectionStatistics PoseReceiver::statistics() const {
  const MutexLock lock(mutex_);
  ConnectionStatistics all;
  all.streams = {stream_};
  all.pairs = frames_out_;
  all.dropped = dropped_;
  all.map_moves = map_epoch_;
  all.clock_restarts = clock_steps_;
  return all;
}

}  // namespace orthonav::igtl
