#include "hal/igtl/pose_receiver.h"

#include <poll.h>

#include <array>
#include <utility>

#include "base/guarded.h"
#include "base/joined.h"

namespace orthonav::igtl {
namespace {

/// How often timed actions are checked.
constexpr int kTurn_ms = 5;
constexpr int kReadsATurn = 16;
constexpr std::size_t kMostBytesPerSecond = std::size_t{32} << 20;
/// Poses delayed by more than this are useless; a new connection is likely to remove the cause.
constexpr Duration kTooLate = std::chrono::seconds(1);
constexpr Duration kTooLateFor = std::chrono::seconds(5);

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
    if (::poll(watched.data(), watched.size(), kTurn_ms) < 0) {
      watched[1].revents = 0;
    }
    turn(watched[1].revents, HostClock::now());
  }
}

void PoseReceiver::turn(short revents, HostTime now) {
  const bool is_new = link_.step(revents, now) == net::Link::Step::kConnected;
  if (is_new) {
    // A tracker sends nothing while all tools are out of sight: silence alone does not mean a lost
    // connection.
    net::keep_alive(link_.socket());
    incoming_ = Incoming(this);
    sender_.forget();
    frames_.forget();
    late_since_.reset();
    const MutexLock lock(mutex_);
    ++stream_.connections;
    // The tracker's frame may no longer be where it was before.
    map_epoch_ += std::exchange(was_connected_, true) ? 1 : 0;
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
    taken = taken ? watch_lateness(arrived_) : taken;
    if (!taken) {
      return lose(taken.error().message, now);
    }
  }
}

Status PoseReceiver::count_bytes(std::size_t count, HostTime now) {
  const MutexLock lock(mutex_);
  stream_.bytes += static_cast<std::int64_t>(count);
  if (bytes_.allows(count, kMostBytesPerSecond, now)) {
    return {};
  }
  return Error{"sends more than " + std::to_string(kMostBytesPerSecond) + " bytes a second"};
}

Status PoseReceiver::watch_lateness(Timestamp now) {
  if (sender_.late() <= kTooLate) {
    late_since_.reset();
    return {};
  }
  late_since_ = late_since_.value_or(now);
  if (now - *late_since_ <= kTooLateFor) {
    return {};
  }
  return Error{"poses come " + std::to_string(seconds(sender_.late())) + " s late"};
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
  const Timestamp time = sender_.time_of(header.timestamp, arrived_);
  for (const SentPose& pose : *poses) {
    frames_.take(pose, time, arrived_);
  }
  return {};
}

void PoseReceiver::lose(const std::string& why, HostTime now) {
  link_.drop(why, now);
  const MutexLock lock(mutex_);
  waiting_.reset();
  lost_ = why;
  stream_.last_trouble = why;
}

void PoseReceiver::publish(const PoseFrame& frame) {
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

Result<Next> PoseReceiver::next(StereoFrame& frame) {
  const MutexLock lock(mutex_);
  if (!died_) {
    return died_.error();
  }
  if (lost_) {
    return Error{"igtl: " + options_.host +
                     ": connection lost: " + std::exchange(lost_, std::nullopt).value_or(""),
                 ErrorCode::kLost};
  }
  if (!waiting_) {
    return Next::kNone;
  }
  frame.left.clear();
  frame.right.clear();
  frame.sequence = ++sequence_;
  frame.map_epoch = map_epoch_;
  frame.time = waiting_->time;
  // The tracker's frame is World and does not move.
  frame.world_from_rig = Transform<World, Rig>{};
  frame.head_covariance.reset();
  frame.tools.assign(waiting_->tools.begin(), waiting_->tools.end());
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
  return all;
}

}  // namespace orthonav::igtl
