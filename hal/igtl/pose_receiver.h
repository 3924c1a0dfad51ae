#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/mutex.h"
#include "hal/api/devices.h"
#include "hal/igtl/incoming.h"
#include "hal/igtl/pose_frames.h"
#include "hal/igtl/sender_clock.h"
#include "hal/igtl/tracker_options.h"
#include "hal/net/link.h"
#include "hal/net/rate_limit.h"

namespace orthonav::igtl {

/// This machine's steady clock, from zero.
class SteadyClock : public Clock {
 public:
  [[nodiscard]] Timestamp now() const override {
    return Timestamp(std::chrono::duration_cast<Duration>(HostClock::now() - zero_));
  }

 private:
  HostTime zero_ = HostClock::now();
};

/// The thread that connects to a tracking program, reads the poses that it sends, and keeps the
/// newest frame. It keeps reading whether or not frames are taken, so that nothing queues on the
/// network; data that is not OpenIGTLink, or more than 32 MiB a second, ends a connection.
class PoseReceiver final : private MessageReader {
 public:
  PoseReceiver(const net::Endpoint& host, const TrackerOptions& options);
  ~PoseReceiver() override;
  PoseReceiver(const PoseReceiver&) = delete;
  PoseReceiver& operator=(const PoseReceiver&) = delete;

  [[nodiscard]] const Clock& clock() const { return clock_; }
  /// As ToolPoseSource::do_next. An Error once for each lost connection, for each time that the
  /// sender's clock was set, and for each tool that comes in another frame than asked for; at every
  /// call after the receiver's thread has ended.
  Result<Next> next(ToolPoses& poses) ORTHONAV_EXCLUDES(mutex_);
  /// Time of the newest frame.
  [[nodiscard]] std::optional<Timestamp> newest() const ORTHONAV_EXCLUDES(mutex_);
  /// Whether a pose of any tool has arrived.
  [[nodiscard]] bool has_heard() const ORTHONAV_EXCLUDES(mutex_);
  /// Why no tool's pose has arrived.
  [[nodiscard]] std::string trouble() const ORTHONAV_EXCLUDES(mutex_);
  [[nodiscard]] ConnectionStatistics statistics() const ORTHONAV_EXCLUDES(mutex_);

 private:
  void run();
  void turn(short revents, HostTime now);
  void read_all(HostTime now);
  Status count_bytes(std::size_t count, HostTime now);
  void begin_connection() ORTHONAV_EXCLUDES(mutex_);
  void complain(const std::string& what) ORTHONAV_EXCLUDES(mutex_);
  void lose(const std::string& why, HostTime now) ORTHONAV_EXCLUDES(mutex_);
  void publish(const ToolPoses& frame) ORTHONAV_EXCLUDES(mutex_);
  void tell() ORTHONAV_EXCLUDES(mutex_);
  [[nodiscard]] bool wants(const Header& header) const override { return holds_poses(header.type); }
  Status read(const Header& header, Bytes body) override ORTHONAV_EXCLUDES(mutex_);

  const TrackerOptions options_;
  const SteadyClock clock_;
  const net::WakeUp wake_up_;
  std::atomic<bool> stop_ = false;

  // Used by the thread only.
  net::Link link_;
  Incoming incoming_{this};
  SenderClock sender_;
  PoseFrames frames_;
  Timestamp arrived_{};  ///< arrival time of the bytes being read
  std::optional<HostClock::duration> shortest_round_trip_;
  bool was_connected_ = false;  ///< ever
  net::RateLimit bytes_;

  mutable Mutex mutex_;
  std::optional<ToolPoses> waiting_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<Timestamp> newest_ ORTHONAV_GUARDED_BY(mutex_);
  std::vector<Error> to_tell_ ORTHONAV_GUARDED_BY(mutex_);
  Status died_ ORTHONAV_GUARDED_BY(mutex_);  ///< why its thread ended
  std::int64_t map_epoch_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::int64_t sequence_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::int64_t dropped_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::int64_t clock_steps_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::int64_t frames_out_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  StreamStatistics stream_ ORTHONAV_GUARDED_BY(mutex_);
  bool heard_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::string others_ ORTHONAV_GUARDED_BY(mutex_);  ///< transforms that belong to no tool
  std::thread thread_;
};

}  // namespace orthonav::igtl
