#include "hal/hl2ss/hl2ss_headset.h"

#include <algorithm>
#include <future>
#include <thread>
#include <utility>

#include "base/printed.h"
#include "hal/hl2ss/calibration.h"
#include "hal/hl2ss/depth_receiver.h"
#include "hal/hl2ss/receiver.h"
#include "hal/net/host_port.h"

namespace orthonav::hl2ss {
namespace {

/// The display is not part of the protocol: assumes one refresh of a HoloLens 2 at 60 Hz.
constexpr Duration kDisplayLatency = std::chrono::milliseconds(16);
/// A server without the configuration port is acceptable.
constexpr Duration kConfigurationWithin = std::chrono::milliseconds(500);
constexpr std::uint8_t kAskUtcOffset = 1;

Error trouble_with(const std::string& host, const Error& what) {
  return Error{"hl2ss: " + host + ": " + what.message, what.code};
}

Result<StereoCalibration> ask_calibration(const net::Endpoint& endpoint,
                                          const Hl2ssOptions& options, HostTime deadline) {
  const auto request = request_bytes({Mode::kCalibration});
  const auto answer = [&](Service service) {
    return ask(endpoint, options.first_port + offset_of(service), request, kCalibrationBytes,
               deadline);
  };
  const auto left_bytes = answer(Service::kLeftFront);
  if (!left_bytes) {
    return left_bytes.error();
  }
  auto left = read_left_calibration(*left_bytes);
  if (!left) {
    return Error{"left camera: " + left.error().message};
  }
  const auto right_bytes = answer(Service::kRightFront);
  if (!right_bytes) {
    return right_bytes.error();
  }
  auto right = read_right_calibration(*right_bytes);
  if (!right) {
    return Error{"right camera: " + right.error().message};
  }
  return StereoCalibration{std::move(left->camera), std::move(right->camera), left->camera_from_rig,
                           right->camera_from_rig};
}

/// Absent: no depth was requested. It is computed while the cameras are opened.
using AskedDepth = std::future<Result<DepthDescription>>;
std::optional<AskedDepth> begin_asking_depth(const net::Endpoint& endpoint,
                                             const Hl2ssOptions& options, HostTime deadline) {
  if (!options.depth) {
    return std::nullopt;
  }
  const HostTime within =
      std::min(deadline, HostClock::now() +
                             std::chrono::duration_cast<HostClock::duration>(options.depth_within));
  const DepthStream stream = options.depth->stream;
  const int port = options.first_port + offset_of(format_of(stream).service);
  return std::async(std::launch::async, [=]() -> Result<DepthDescription> {
    const std::uint8_t request[] = {static_cast<std::uint8_t>(Mode::kCalibration)};
    const auto answer = ask(endpoint, port, request, depth_calibration_bytes(stream), within);
    if (!answer) {
      return answer.error();
    }
    auto described = read_depth_calibration(stream, *answer);
    return described ? std::move(described)
                     : Error{"port " + std::to_string(port) + ": " + described.error().message};
  });
}

/// 0 if the server does not provide it: stamps then count from an unknown moment.
std::int64_t ask_utc_offset(const net::Endpoint& endpoint, const Hl2ssOptions& options,
                            HostTime deadline) {
  const std::uint8_t request[] = {kAskUtcOffset};
  const HostTime now = HostClock::now();
  // If there is no answer, most of the time is left for the images.
  const HostTime within =
      now + std::min<HostClock::duration>(kConfigurationWithin, (deadline - now) / 4);
  const auto answer = ask(endpoint, options.first_port + offset_of(Service::kConfiguration),
                          request, sizeof(std::uint64_t), within);
  if (!answer) {
    return 0;
  }
  const auto offset = number_at<std::uint64_t>(*answer, 0);
  // Beyond the year 2300 it is invalid.
  return offset <= 220'000'000'000'000'000u ? static_cast<std::int64_t>(offset) : 0;
}

class Cameras final : public StereoCamera {
 public:
  Cameras(Receiver& receiver, StereoCalibration calibration)
      : receiver_(receiver), calibration_(std::move(calibration)) {}

 private:
  [[nodiscard]] const StereoCalibration& do_calibration() const override { return calibration_; }
  [[nodiscard]] MayRepeat do_may_repeat() const override {
    return receiver_.standin() ? receiver_.standin()->may_repeat() : MayRepeat{};
  }
  Result<Next> do_next(StereoFrame& frame) override {
    StandinStream* standin = receiver_.standin();
    // A request for the next pair means that the caller is done with the last one.
    if (standin && taken_) {
      standin->send(StandinTook{*std::exchange(taken_, std::nullopt)});
    }
    if (auto trouble = receiver_.pairs().trouble()) {
      return std::move(*trouble);
    }
    const bool ended = standin && standin->has_ended();
    const auto waiting = receiver_.pairs().waiting();
    if (!waiting) {
      return ended ? Next::kEnd : Next::kNone;
    }
    if (standin && !standin->admits(*waiting - receiver_.stamps_left_late())) {
      return Next::kNone;
    }
    if (!receiver_.pairs().take(frame)) {
      return Next::kNone;
    }
    taken_ = frame.time;
    return Next::kFrame;
  }
  bool do_tap(PairTap* tap) override {
    if (receiver_.standin() && receiver_.standin()->is_paced()) {
      return false;
    }
    receiver_.pairs().tap(tap);
    return true;
  }

  Receiver& receiver_;
  StereoCalibration calibration_;
  std::optional<Timestamp> taken_;  ///< handed out, but not yet reported to the stand-in
};

class InboxClicker final : public Clicker {
 public:
  explicit InboxClicker(Receiver& receiver) : receiver_(receiver) {}

 private:
  Status do_poll(Timestamp until, std::vector<ClickerEvent>& events) override {
    receiver_.clicks().take_until(until, events);
    return {};
  }
  Receiver& receiver_;
};

class InboxVoice final : public Voice {
 public:
  explicit InboxVoice(Receiver& receiver) : receiver_(receiver) {}

 private:
  Status do_poll(Timestamp until, std::vector<Phrase>& phrases) override {
    receiver_.phrases().take_until(until, phrases);
    return {};
  }
  Receiver& receiver_;
};

class RemoteWearer final : public Wearer {
 public:
  explicit RemoteWearer(Receiver& receiver) : receiver_(receiver) {}
  void see(const WornFrame& frame) override { receiver_.standin()->send(StandinShown{frame}); }

 private:
  Receiver& receiver_;
};

class ConnectedHeadset final : public Hl2ssHeadset {
 public:
  ConnectedHeadset(std::string host, std::unique_ptr<Receiver> receiver,
                   StereoCalibration calibration, std::int64_t epoch_ticks)
      : host_(std::move(host)),
        epoch_ticks_(epoch_ticks),
        receiver_(std::move(receiver)),
        cameras_(*receiver_, std::move(calibration)),
        clicker_(*receiver_),
        voice_(*receiver_),
        wearer_(*receiver_) {}
  [[nodiscard]] std::string name() const override { return "hl2ss://" + net::before_port(host_); }
  [[nodiscard]] const Clock& clock() const override { return receiver_->clock(); }
  [[nodiscard]] std::int64_t epoch_ticks_100ns() const override { return epoch_ticks_; }
  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }
  [[nodiscard]] HeadTracker& head() override { return receiver_->head(); }
  [[nodiscard]] Clicker& clicker() override { return clicker_; }
  [[nodiscard]] Voice& voice() override { return voice_; }
  [[nodiscard]] Duration display_latency() const override {
    const auto told = receiver_->standin() ? receiver_->standin()->display_latency() : std::nullopt;
    return told.value_or(kDisplayLatency);
  }
  [[nodiscard]] Microphone* microphone() override { return &receiver_->microphone(); }
  [[nodiscard]] ObjectDisplay* objects() override { return receiver_->scene(); }
  [[nodiscard]] Wearer* wearer() override { return receiver_->standin() ? &wearer_ : nullptr; }
  [[nodiscard]] std::vector<DepthCamera*> depth_cameras() override {
    return depth_ ? std::vector{&depth_->camera()} : std::vector<DepthCamera*>();
  }
  [[nodiscard]] const std::string& depth_trouble() const override { return depth_trouble_; }
  [[nodiscard]] ConnectionStatistics statistics() const override {
    ConnectionStatistics all = receiver_->statistics();
    if (depth_) {
      all.streams.push_back(depth_->statistics());
    }
    return all;
  }
  /// Must be called before the depth cameras are used.
  void add_depth(const net::Endpoint& endpoint, const Hl2ssOptions& options,
                 Result<DepthDescription> described) {
    auto depth = described
                     ? DepthReceiver::start(endpoint, options, std::move(*described), *receiver_)
                     : described.error();
    if (depth) {
      depth_ = std::move(*depth);
    } else {
      depth_trouble_ = std::string("no depth camera ") + name_of(options.depth->stream) + ": " +
                       depth.error().message;
    }
  }

 private:
  std::string host_;
  std::int64_t epoch_ticks_;
  std::unique_ptr<Receiver> receiver_;
  Cameras cameras_;
  InboxClicker clicker_;
  InboxVoice voice_;
  RemoteWearer wearer_;
  std::unique_ptr<DepthReceiver> depth_;
  std::string depth_trouble_;
};

Status wait_for_pair(const Receiver& receiver, const Hl2ssOptions& options, HostTime deadline,
                     const StandinStream* standin) {
  while (!receiver.has_paired() || (standin && !standin->display_latency())) {
    if (HostClock::now() >= deadline) {
      const std::string why = receiver.troubles();
      return Error{printed("no pair of images within %.1f s", seconds(options.open_within)) +
                       (why.empty() ? "" : "; " + why),
                   ErrorCode::kUnavailable};
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<Hl2ssHeadset>> Hl2ssHeadset::open(const Hl2ssOptions& options) {
  const auto endpoint = net::resolve(options.host);
  if (!endpoint) {
    return trouble_with(options.host, endpoint.error());
  }
  const HostTime deadline = HostClock::now() + options.open_within;
  auto asked_depth = begin_asking_depth(*endpoint, options, deadline);
  auto calibration = ask_calibration(*endpoint, options, deadline);
  if (!calibration) {
    return trouble_with(options.host, calibration.error());
  }
  const std::int64_t utc_offset = ask_utc_offset(*endpoint, options, deadline);
  auto receiver = Receiver::start(*endpoint, options, utc_offset);
  if (!receiver) {
    return trouble_with(options.host, receiver.error());
  }
  if (const Status came = wait_for_pair(**receiver, options, deadline, (*receiver)->standin());
      !came) {
    return trouble_with(options.host, came.error());
  }
  const std::int64_t base = (*receiver)->base_ticks();
  // Stamps that are FILETIME already need no offset.
  const std::int64_t epoch = base != 0 ? base : utc_offset;
  auto headset = std::make_unique<ConnectedHeadset>(options.host, std::move(*receiver),
                                                    std::move(*calibration), epoch);
  if (asked_depth) {
    headset->add_depth(*endpoint, options, asked_depth->get());
  }
  return std::unique_ptr<Hl2ssHeadset>(std::move(headset));
}

HeadsetScheme scheme() {
  const auto check = [](const std::string& rest) {
    const auto options = options_of(rest);
    return options ? Status{} : Status(options.error());
  };
  const auto open = [](const std::string& rest,
                       const std::vector<std::string>& phrases) -> Result<OpenedDevice> {
    auto options = options_of(rest);
    if (!options) {
      return options.error();
    }
    options->phrases = phrases;
    auto opened = Hl2ssHeadset::open(*options);
    if (!opened) {
      return opened.error();
    }
    std::string warning = (*opened)->depth_trouble();
    return OpenedDevice{std::move(*opened), std::move(warning)};
  };
  return {"hl2ss", "hl2ss://HOST", check, open};
}

}  // namespace orthonav::hl2ss
