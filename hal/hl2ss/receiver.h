#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "hal/hl2ss/connection.h"
#include "hal/hl2ss/event_streams.h"
#include "hal/hl2ss/map_watch.h"
#include "hal/hl2ss/options.h"
#include "hal/hl2ss/pair_mailbox.h"
#include "hal/hl2ss/standin_stream.h"
#include "hal/hl2ss/video_stream.h"

namespace orthonav::hl2ss {

/// The one thread that reads every stream of a headset, decodes, pairs and publishes. It always
/// reads on, whoever takes what it publishes or not, so that nothing ever queues on the network.
class Receiver final : private ImageSink {
 public:
  /// `filetime_offset`: UTC in ticks of 100 ns minus the headset's stamps.
  static Result<std::unique_ptr<Receiver>> start(const Endpoint& host, const Hl2ssOptions& options,
                                                 std::int64_t filetime_offset);
  ~Receiver() override;
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  [[nodiscard]] PairMailbox& pairs() { return pairs_; }
  [[nodiscard]] HeadTrack& head() { return head_; }
  [[nodiscard]] const BootClock& clock() const { return time_.clock; }
  [[nodiscard]] Inbox<ClickerEvent>& clicks() { return clicks_; }
  [[nodiscard]] Inbox<Phrase>& phrases() { return phrases_; }
  /// Null without a stand-in.
  [[nodiscard]] StandinStream* standin() { return standin_; }
  /// Begins to listen, at the first question.
  [[nodiscard]] Microphone& microphone();
  /// Whether a front camera has sent anything; the base of its stamps is known then.
  [[nodiscard]] bool has_heard() const { return heard_.load(); }
  [[nodiscard]] std::int64_t base_ticks() const;
  [[nodiscard]] ConnectionStatistics statistics() const;
  /// What the streams that are not connected last suffered.
  [[nodiscard]] std::string troubles() const;

 private:
  struct Stream {
    std::unique_ptr<ArrivalMeter> meter;
    std::unique_ptr<Protocol> protocol;
    std::unique_ptr<Connection> connection;
  };
  Receiver(const Endpoint& host, const Hl2ssOptions& options) : host_(host), options_(options) {}
  Status add_cameras();
  Status add_events(std::int64_t filetime_offset);
  template <class Make>
  auto& add(const std::string& name, int port, Duration interval, Duration longest_silence,
            Make make);
  void run();
  void take(Side side, CameraImage& image) override;
  void lost(Side side) override;
  void publish(const Pairer::Pair& pair);

  Endpoint host_;
  Hl2ssOptions options_;
  WakeUp wake_up_;
  HeadsetTime time_;
  PairMailbox pairs_;
  HeadTrack head_;
  Inbox<ClickerEvent> clicks_;
  Inbox<Phrase> phrases_;
  std::atomic<bool> heard_ = false;
  std::atomic<bool> stop_ = false;

  mutable std::mutex mutex_;  ///< of everything below
  std::vector<Stream> streams_;
  StandinStream* standin_ = nullptr;
  SoundStream* sound_ = nullptr;
  Pairer pairer_;
  MapWatch map_;
  std::int64_t map_epoch_ = 0;
  std::int64_t restarts_ = 0;
  std::int64_t late_pairs_ = 0;
  std::thread thread_;
};

}  // namespace orthonav::hl2ss
