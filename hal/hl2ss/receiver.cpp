#include "hal/hl2ss/receiver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/findings.h"
#include "base/guarded.h"
#include "base/printed.h"
#include "hal/api/research_mode.h"

namespace orthonav::hl2ss {
namespace {

/// A picture may depend on at most one second of earlier ones.
constexpr std::uint64_t kGopSize = 30;
constexpr Duration kSilence = std::chrono::seconds(3);
/// A stand-in that waits for its client may be silent for as long as the client computes.
constexpr Duration kPacedSilence = std::chrono::minutes(2);
/// The clock is estimated from transit times and is late by some milliseconds.
constexpr Duration kMaxAhead = std::chrono::milliseconds(100);
/// How often timed actions are checked.
constexpr int kTurnMs = 10;
/// Without a pair for this long, the reasons are told, as when opening.
constexpr Duration kNoPairFor = std::chrono::seconds(8);
/// Both cameras believe a clock that was set after the same number of pictures, and by the same.
constexpr Duration kLeapTogether = std::chrono::seconds(1);
constexpr Duration kSameLeap = std::chrono::milliseconds(10);

std::int64_t came(const StreamStatistics& stream) { return stream.packets + stream.damaged; }

}  // namespace

Result<std::unique_ptr<Receiver>> Receiver::start(const net::Endpoint& host,
                                                  const Hl2ssOptions& options,
                                                  std::int64_t filetime_offset) {
  auto receiver = std::unique_ptr<Receiver>(new Receiver(host, options));
  if (const Status added = receiver->add_all(filetime_offset); !added) {
    return added.error();
  }
  receiver->thread_ = std::thread([self = receiver.get()] {
    const Status died = guarded("hl2ss", [self] { self->run(); });
    if (!died) {
      self->pairs_.die(died.error());
    }
  });
  return receiver;
}

Receiver::~Receiver() {
  stop_ = true;
  wake_up_.wake();
  if (thread_.joinable()) {
    thread_.join();
  }
}

template <class Make>
auto& Receiver::add(const std::string& name, int port, Duration interval, Duration longest_silence,
                    Make make) {
  Stream stream;
  stream.meter = std::make_unique<ArrivalMeter>(name, interval);
  auto protocol = make(*stream.meter);
  auto& made = *protocol;
  stream.protocol = std::move(protocol);
  stream.connection = std::make_unique<Connection>(
      host_, Connection::Options{port, longest_silence}, *stream.meter, *stream.protocol);
  streams_.push_back(std::move(stream));
  return made;
}

Status Receiver::add_all(std::int64_t filetime_offset) {
  const MutexLock lock(mutex_);
  if (const Status added = add_cameras(); !added) {
    return added;
  }
  return add_events(filetime_offset);
}

Status Receiver::add_cameras() {
  const Duration silence = options_.standin_port > 0 ? kPacedSilence : kSilence;
  ImageSink& sink = *this;
  for (const CameraSide side : {CameraSide::kLeft, CameraSide::kRight}) {
    std::unique_ptr<VideoDecoder> decoder;
    if (options_.profile != VideoProfile::kRaw) {
      auto made = VideoDecoder::create(kImageWidthPx, kImageHeightPx);
      if (!made) {
        return made.error();
      }
      decoder = std::move(*made);
    }
    const VideoRequest request{
        Mode::kVideoAndPose, 1, options_.profile, options_.bitrate,
        VideoOptions{kGopSize, 0.0, -(options_.stamps_late / Duration(100))}};
    const Service service = side == CameraSide::kLeft ? Service::kLeftFront : Service::kRightFront;
    add(side == CameraSide::kLeft ? "left camera" : "right camera",
        options_.first_port + offset_of(service), kGreyCameraInterval, silence,
        [&](ArrivalMeter& meter) {
          return std::make_unique<VideoStream>(side, request, std::move(decoder), meter, time_,
                                               sink);
        });
  }
  return {};
}

Status Receiver::add_events(std::int64_t filetime_offset) {
  const auto port = [this](Service service) { return options_.first_port + offset_of(service); };
  if (!options_.phrases.empty()) {
    auto vocabulary = vocabulary_bytes(options_.phrases);
    if (!vocabulary) {
      return vocabulary.error();
    }
    add("voice", port(Service::kVoice), Duration::max() / 2, kSilence, [&](ArrivalMeter& meter) {
      return std::make_unique<VoiceStream>(options_.phrases, std::move(*vocabulary),
                                           filetime_offset, meter, time_, phrases_);
    });
  }
  if (options_.standin_port > 0) {
    standin_ = &add("stand-in", options_.standin_port, Duration::max() / 2, kPacedSilence,
                    [this](ArrivalMeter&) {
                      return std::make_unique<StandinStream>(time_, clicks_, wake_up_);
                    });
  }
  if (options_.scene) {
    scene_ = &add("scene", port(Service::kScene), Duration::max() / 2, kSilence,
                  [this](ArrivalMeter& meter) {
                    return std::make_unique<SceneStream>(meter, time_, wake_up_);
                  });
  }
  return {};
}

Microphone& Receiver::microphone() {
  const MutexLock lock(mutex_);
  if (!sound_) {
    sound_ = &add("microphone", options_.first_port + offset_of(Service::kMicrophone),
                  std::chrono::milliseconds(21), kSilence, [this](ArrivalMeter& meter) {
                    return std::make_unique<SoundStream>(meter, time_);
                  });
  }
  wake_up_.wake();
  return *sound_;
}

void Receiver::run() {
  std::vector<pollfd> watched;
  while (!stop_) {
    {
      const MutexLock lock(mutex_);
      watched.assign(1, {wake_up_.fd(), POLLIN, 0});
      for (const Stream& stream : streams_) {
        watched.push_back({stream.connection->fd(), stream.connection->events(), 0});
      }
    }
    net::wait_for_news(watched, kTurnMs);
    if (watched[0].revents != 0) {
      wake_up_.clear();
    }
    const MutexLock lock(mutex_);
    const HostTime now = HostClock::now();
    for (std::size_t i = 0; i + 1 < watched.size(); ++i) {
      Connection& connection = *streams_[i].connection;
      const bool was_connected = connection.is_connected();
      connection.step(watched[i + 1].revents, now);
      if (!was_connected && connection.is_connected()) {
        time_.clock.round_trip(connection.round_trip());
      }
    }
    tell_no_pair(now);
  }
  const MutexLock lock(mutex_);
  for (const Stream& stream : streams_) {
    stream.connection->leave();
  }
}

void Receiver::take(CameraSide side, CameraImage& image) {
  if (time_.stamps.restarts() != restarts_) {
    restarts_ = time_.stamps.restarts();
    pairer_.forget();
    // After a lost connection the headset was restarted, and its map with it; otherwise its clock
    // was set, which does not move the map.
    if (was_lost_) {
      map_.break_off();
    }
  }
  if (const auto pair = pairer_.add(side, image)) {
    publish(*pair);
  }
}

void Receiver::publish(const Pairer::Pair& pair) {
  // The right camera's pose may be of a different moment; the pair uses the left one's.
  const auto& pose = pair.left.world_from_rig;
  // Stamps that repeat are not delivered, but the watch must know of them.
  if (pose && map_.moved(pair.left.time, *pose)) {
    ++map_epoch_;
  }
  if (newest_pair_ && pair.left.time <= *newest_pair_) {
    ++late_pairs_;
    return;
  }
  newest_pair_ = pair.left.time;
  paired_ = true;
  paired_or_told_ = HostClock::now();
  for (std::size_t i = 0; i < came_until_pair_.size(); ++i) {
    came_until_pair_[i] = came(streams_[i].meter->statistics());
  }
  was_lost_ = false;
  // The head first, since the pair's consumer asks for it at once.
  if (pose) {
    head_.add(pair.left.time, *pose, map_epoch_);
  }
  pairs_.put(pair, map_epoch_);
}

/// A clock that was set shows in both cameras at once; in one alone, its first image was wrong.
void Receiver::leapt(CameraSide side, Duration by) {
  const HostTime now = HostClock::now();
  const auto mine = static_cast<std::size_t>(side);
  leaps_[mine] = Leap{by, now};
  const auto& other = leaps_[1 - mine];
  if (!other || now - other->at > kLeapTogether || std::chrono::abs(by - other->by) > kSameLeap) {
    return;
  }
  leaps_ = {};
  time_.stamps.set_by(by);
  time_.clock.restart();
  pairs_.fail(Error{printed(
      "hl2ss: %s: the headset's clock was set %s by %.3f s: pairs go on by it",
      options_.host.c_str(), by < Duration::zero() ? "back" : "forward", std::abs(seconds(by)))});
}

void Receiver::tell_no_pair(HostTime now) {
  if (!newest_pair_ || now - paired_or_told_ < kNoPairFor || (standin_ && standin_->is_paced())) {
    return;
  }
  paired_or_told_ = now;
  pairs_.fail(Error{"hl2ss: " + options_.host + ": no pair of images for 8 s; " + why_no_pair(),
                    ErrorCode::kUnavailable});
}

void Receiver::lost(CameraSide side) {
  was_lost_ = true;
  pairer_.forget();
  pairs_.clear();
  head_.lose();
  const StreamStatistics& camera = streams_[static_cast<std::size_t>(side)].meter->statistics();
  pairs_.fail(Error{
      "hl2ss: " + options_.host + ": connection lost; " + camera.name + ": " + camera.last_trouble,
      ErrorCode::kLost});
}

Result<Timestamp> Receiver::time_of(std::uint64_t ticks, HostTime at) const {
  std::optional<Timestamp> time;
  {
    const MutexLock lock(mutex_);
    time = time_.stamps.told(ticks, at);
  }
  if (!time) {
    return Error{"stamp " + std::to_string(ticks) + " is more than 10 s from the cameras'"};
  }
  const double ahead_s = seconds(*time - clock().now());
  if (ahead_s > seconds(kMaxAhead)) {
    return refused("stamp %.1f ms ahead of the headset's clock, limit %.1f ms", ahead_s * 1e3,
                   seconds(kMaxAhead) * 1e3);
  }
  return *time;
}

std::int64_t Receiver::base_ticks() const {
  const MutexLock lock(mutex_);
  return time_.stamps.base_ticks();
}

ConnectionStatistics Receiver::statistics() const {
  const MutexLock lock(mutex_);
  ConnectionStatistics all;
  for (const Stream& stream : streams_) {
    all.streams.push_back(stream.meter->statistics());
  }
  PairMailbox::Figures figures = pairs_.figures();
  all.pairs = figures.pairs;
  all.dropped = figures.dropped;
  all.publish_ms = std::move(figures.publish_ms);
  all.take_ms = std::move(figures.take_ms);
  all.unpaired = pairer_.unpaired() + 2 * late_pairs_;
  all.map_moves = map_epoch_;
  all.clock_restarts = time_.stamps.restarts();
  all.clock_offset = time_.clock.offset();
  all.clock_spread_ms = seconds(time_.clock.spread()) * 1e3;
  return all;
}

std::string Receiver::troubles() const {
  const MutexLock lock(mutex_);
  return why_no_pair();
}

std::string Receiver::why_no_pair() const {
  std::string all;
  const auto add = [&all](const std::string& name, const std::string& trouble) {
    all += (all.empty() ? "" : "; ") + name + ": " + trouble;
  };
  bool cameras_send = true;
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    const StreamStatistics& each = streams_[i].meter->statistics();
    const bool is_connected = streams_[i].connection->is_connected();
    const bool is_camera = i < came_until_pair_.size();
    const bool is_silent = is_camera && came(each) == came_until_pair_[i];
    cameras_send = cameras_send && !(is_camera && (is_silent || each.damaged > 0));
    if (is_connected && is_silent) {
      add(each.name, "connected, but sends no image");
    } else if (!each.last_trouble.empty() && (!is_connected || each.damaged > 0)) {
      add(each.name, each.last_trouble);
    }
  }
  if (cameras_send) {
    add("cameras", "send, but no two images of one moment");
  }
  return all;
}

}  // namespace orthonav::hl2ss
