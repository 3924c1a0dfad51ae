#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/mutex.h"
#include "hal/api/map_watch.h"
#include "hal/hl2ss/connection.h"
#include "hal/hl2ss/event_streams.h"
#include "hal/hl2ss/head_track.h"
#include "hal/hl2ss/options.h"
#include "hal/hl2ss/pair_mailbox.h"
#include "hal/hl2ss/scene_stream.h"
#include "hal/hl2ss/standin_stream.h"
#include "hal/hl2ss/video_stream.h"

namespace orthonav::hl2ss {

/// The one thread that reads every stream of a headset, decodes, pairs and publishes. It keeps
/// reading whether or not its results are taken, so that nothing ever queues on the network.
class Receiver final : private ImageSink {
 public:
  /// `filetime_offset`: UTC in ticks of 100 ns minus the headset's stamps.
  static Result<std::unique_ptr<Receiver>> start(const net::Endpoint& host,
                                                 const Hl2ssOptions& options,
                                                 std::int64_t filetime_offset);
  ~Receiver() override;
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  [[nodiscard]] PairMailbox& pairs() { return pairs_; }
  [[nodiscard]] HeadTrack& head() { return head_; }
  [[nodiscard]] const BootClock& clock() const { return time_.clock; }
  /// For a stream that must not affect the others: the time of a stamp, and the map that the head
  /// is in (`HeadTrack::place`).
  [[nodiscard]] Result<Timestamp> time_of(std::uint64_t ticks, HostTime at) const;
  std::int64_t place(Timestamp at, std::optional<Transform<World, Rig>>& world_from_rig) const {
    return head_.place(at, world_from_rig);
  }
  /// Whether a stand-in has announced the end.
  [[nodiscard]] bool has_ended() const { return standin_ && standin_->has_ended(); }
  [[nodiscard]] Inbox<ClickerEvent>& clicks() { return clicks_; }
  [[nodiscard]] Inbox<Phrase>& phrases() { return phrases_; }
  /// Null without a stand-in.
  [[nodiscard]] StandinStream* standin() { return standin_; }
  /// Null if not wanted.
  [[nodiscard]] ObjectDisplay* scene() { return scene_; }
  /// Starts listening at the first call.
  [[nodiscard]] Microphone& microphone();
  /// Whether both cameras have sent pictures of one moment; the base of their stamps is then known.
  [[nodiscard]] bool has_paired() const { return paired_.load(); }
  [[nodiscard]] std::int64_t base_ticks() const;
  [[nodiscard]] ConnectionStatistics statistics() const;
  /// The last errors of streams that are not connected, the reasons for refused packets of the
  /// others, and which of the cameras sends nothing.
  [[nodiscard]] std::string troubles() const;

  /// The lateness of stamps that remains with the requested options on a HoloLens 2.
  [[nodiscard]] Duration stamps_left_late() const {
    return kResearchModeStampsLate - options_.stamps_late;
  }

 private:
  struct Stream {
    std::unique_ptr<ArrivalMeter> meter;
    std::unique_ptr<Protocol> protocol;
    std::unique_ptr<Connection> connection;
  };
  Receiver(const net::Endpoint& host, const Hl2ssOptions& options)
      : host_(host), options_(options) {}
  Status add_all(std::int64_t filetime_offset) ORTHONAV_EXCLUDES(mutex_);
  Status add_cameras() ORTHONAV_REQUIRES(mutex_);
  Status add_events(std::int64_t filetime_offset) ORTHONAV_REQUIRES(mutex_);
  template <class Make>
  auto& add(const std::string& name, int port, Duration interval, Duration longest_silence,
            Make make) ORTHONAV_REQUIRES(mutex_);
  void run() ORTHONAV_EXCLUDES(mutex_);
  // Called by the streams, which `run` drives under the mutex.
  void take(CameraSide side, CameraImage& image) override ORTHONAV_REQUIRES(mutex_);
  void lost(CameraSide side) override ORTHONAV_REQUIRES(mutex_);
  void leapt(CameraSide side, Duration by) override ORTHONAV_REQUIRES(mutex_);
  void tell_no_pair(HostTime now) ORTHONAV_REQUIRES(mutex_);
  [[nodiscard]] std::string why_no_pair() const ORTHONAV_REQUIRES(mutex_);
  void publish(const Pairer::Pair& pair) ORTHONAV_REQUIRES(mutex_);

  net::Endpoint host_;
  Hl2ssOptions options_;
  net::WakeUp wake_up_;
  HeadsetTime time_;
  PairMailbox pairs_;
  HeadTrack head_;
  Inbox<ClickerEvent> clicks_;
  Inbox<Phrase> phrases_;
  std::atomic<bool> paired_ = false;
  std::atomic<bool> stop_ = false;

  StandinStream* standin_ = nullptr;  ///< made before the thread starts, never changed
  SceneStream* scene_ = nullptr;      ///< likewise
  mutable Mutex mutex_;  ///< also guards the stamps in `time_`, which the streams share
  std::vector<Stream> streams_ ORTHONAV_GUARDED_BY(mutex_);
  SoundStream* sound_ ORTHONAV_GUARDED_BY(mutex_) = nullptr;
  Pairer pairer_ ORTHONAV_GUARDED_BY(mutex_);
  MapWatch map_ ORTHONAV_GUARDED_BY(mutex_);
  std::int64_t map_epoch_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::int64_t restarts_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  bool was_lost_ ORTHONAV_GUARDED_BY(mutex_) = false;  ///< since the last pair
  std::optional<Timestamp> newest_pair_ ORTHONAV_GUARDED_BY(mutex_);
  HostTime paired_or_told_ ORTHONAV_GUARDED_BY(mutex_) = HostClock::now();
  std::array<std::int64_t, 2> came_until_pair_
      ORTHONAV_GUARDED_BY(mutex_) = {};  ///< of each camera
  struct Leap {
    Duration by{};
    HostTime at{};
  };
  std::array<std::optional<Leap>, 2> leaps_ ORTHONAV_GUARDED_BY(mutex_);  ///< of each camera
  std::int64_t late_pairs_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::thread thread_;
};

}  // namespace orthonav::hl2ss
