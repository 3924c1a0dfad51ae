#include "hal/hl2ss/server/server.h"

#include <atomic>
#include <optional>
#include <thread>
#include <utility>

#include "base/joined.h"
#include "base/mutex.h"
#include "hal/hl2ss/server/camera_port.h"
#include "hal/hl2ss/server/depth_sender.h"
#include "hal/hl2ss/server/pair_sender.h"
#include "hal/hl2ss/server/port_group.h"
#include "hal/hl2ss/server/served_headset.h"
#include "hal/hl2ss/server/side_ports.h"

namespace orthonav::hl2ss {
namespace {

/// UTC minus the headset's stamps, in ticks of 100 ns.
constexpr std::int64_t kUtcOffsetTicks = 133'000'000'000'000'000;
/// A slice has at least one row of macroblocks, and enough pixels must keep a direction.
constexpr int kMaxSlices = 30;
constexpr int kMaxUnmappedPx = 100;

constexpr auto kIdle = std::chrono::milliseconds(1);
/// A client that is not done with a pair by then has missed it.
constexpr auto kPatience = std::chrono::seconds(10);
constexpr auto kImpatience = std::chrono::milliseconds(20);

class RunningServer final : public Server {
 public:
  RunningServer(const ServerOptions& options, OpenHeadset open, std::unique_ptr<Headset> first)
      : options_(options),
        headset_(std::move(open), std::move(first)),
        left_({headset_.left_calibration(options.unmapped_edge_px), options.faults,
               Random(options.seed).fork("left"), options.slices}),
        right_({headset_.right_calibration(options.unmapped_edge_px), options.faults,
                Random(options.seed).fork("right"), options.slices}),
        sides_(kUtcOffsetTicks),
        scene_(options.faults, Random(options.seed).fork("scene")),
        sender_(options.faults, options.seed, left_, right_, sides_),
        depth_(headset_.depth_calibration(DepthStream::kAhat),
               headset_.depth_calibration(DepthStream::kLongThrow)),
        ports_(ports()) {}
  ~RunningServer() override {
    stop_ = true;
    if (producer_.joinable()) {
      producer_.join();
    }
    if (network_.joinable()) {
      network_.join();
    }
  }

  Status listen(const net::Endpoint& host, const net::Allowed& allowed) {
    const auto first = ports_.listen(host, options_.first_port, allowed);
    first_port_ = first ? *first : 0;
    return first ? Status() : first.error();
  }
  void run() {
    network_ = std::thread([this] { serve(); });
    depth_.start([this] { return sender_.world_from_jumped().inverse(); }, options_.paced);
    producer_ = std::thread([this] { produce(); });
  }
  [[nodiscard]] int first_port() const override { return first_port_; }
  [[nodiscard]] int standin_port() const override { return first_port_ + kStandinOffset; }
  [[nodiscard]] Hl2ssOptions client_options() const override {
    Hl2ssOptions options;
    options.host = "127.0.0.1";
    options.first_port = first_port_;
    if (options_.standin) {
      options.standin_port = standin_port();
    }
    return options;
  }
  [[nodiscard]] ScenePort& scene() override { return scene_; }
  [[nodiscard]] ServerReport report() const override {
    const MutexLock lock(report_mutex_);
    return report_;
  }

 private:
  std::vector<PortGroup::Member> ports() {
    std::vector<PortGroup::Member> all = {
        {&left_.port(), offset_of(Service::kLeftFront)},
        {&right_.port(), offset_of(Service::kRightFront)},
        {&depth_.ahat().port(), offset_of(Service::kAhat)},
        {&depth_.long_throw().port(), offset_of(Service::kLongThrow)},
        {&sides_.configuration, offset_of(Service::kConfiguration)},
        {&sides_.microphone, offset_of(Service::kMicrophone)},
        {&sides_.voice, offset_of(Service::kVoice)},
        {&scene_.port, offset_of(Service::kScene), [this] { return scene_.is_free(); }}};
    if (options_.standin) {
      all.push_back({&sides_.standin, kStandinOffset});
    }
    return all;
  }

  /// The network thread.
  void serve() {
    while (!stop_) {
      ports_.turn();
      scene_.run(HostClock::now());
      show();
    }
  }
  /// Passes the client's frames to the wearer.
  void show() {
    const Transform<World, World> back = sender_.world_from_jumped();
    for (WornFrame& frame : sides_.take_shown()) {
      headset_.show(back, frame);
    }
    sides_.publish_took();
  }

  [[nodiscard]] bool is_wanted() const {
    return left_.is_streaming() && right_.is_streaming() &&
           (!options_.paced || sides_.standin.has_client());
  }

  /// The headset's thread.
  void produce() {
    while (!stop_) {
      if (!is_wanted()) {
        std::this_thread::sleep_for(kIdle);
        continue;
      }
      if (const auto headset = headset_.begin_session([this](Headset& h) { begin(h); })) {
        run_session(**headset);
      } else {
        note([&](ServerReport& report) { report.last_trouble = headset.error().message; });
      }
      end_session();
    }
  }
  void begin(Headset& headset) {
    sender_.restart();
    note([](ServerReport& report) {
      ++report.sessions;
      report.is_streaming = true;
    });
    const Timestamp now = headset.clock().now();
    const Duration latency = headset.display_latency();
    sides_.greet({options_.paced, latency, now, headset.cameras()->may_repeat()});
    depth_.begin(headset);
  }
  void end_session() {
    depth_.end();
    headset_.end_session();
    note([](ServerReport& report) { report.is_streaming = false; });
    sides_.end();
    while (!stop_ && (left_.is_streaming() || right_.is_streaming())) {
      std::this_thread::sleep_for(kIdle);
    }
  }
  void run_session(Headset& headset) {
    StereoFrame frame;
    auto gone_since = HostClock::now();
    while (!stop_) {
      // A client may reconnect; without one, nothing continues.
      if (left_.port().has_client() || right_.port().has_client()) {
        gone_since = HostClock::now();
      }
      if (HostClock::now() - gone_since > kPatience) {
        return;
      }
      const auto next = headset.cameras()->next(frame);
      if (next && *next == Next::kEnd) {
        return;
      }
      if (!next || *next == Next::kNone) {
        std::this_thread::sleep_for(kIdle);
        continue;
      }
      const bool whole = send_pair(headset, frame);
      if (!options_.paced) {
        continue;
      }
      depth_.send_due();
      wait_for_client(whole ? std::optional(frame.time) : std::nullopt);
    }
  }
  /// Waits until the client is done with the pair or has reconnected. After a fault it may need
  /// more data first (a key frame, a new connection), so the wait is short until it follows again.
  void wait_for_client(std::optional<Timestamp> pair_time) {
    const auto deadline = HostClock::now() + (follows_ && pair_time ? kPatience : kImpatience);
    while (!stop_ && pair_time && is_wanted() && !sides_.took(*pair_time) &&
           HostClock::now() < deadline) {
      sides_.wait_for_took();
    }
    follows_ = pair_time && sides_.took(*pair_time);
    const auto back_by = HostClock::now() + kPatience;
    while (!stop_ && !is_wanted() && HostClock::now() < back_by) {
      sides_.wait_for_took();
    }
  }

  /// Whether the client can be done with it.
  bool send_pair(Headset& headset, const StereoFrame& frame) {
    const auto whole = sender_.send(headset, frame);
    note([&](ServerReport& report) {
      ++report.pairs;
      report.faults = sender_.faults_done();
      report.world_from_rig.reset();
      if (frame.world_from_rig) {
        report.world_from_rig = sender_.world_from_jumped().inverse() * *frame.world_from_rig;
      }
      if (!whole) {
        report.last_trouble = whole.error().message;
      }
    });
    return whole && *whole;
  }
  void note(auto what) {
    const MutexLock lock(report_mutex_);
    what(report_);
  }

  ServerOptions options_;
  ServedHeadset headset_;
  CameraPort left_;
  CameraPort right_;
  SidePorts sides_;
  ScenePort scene_;
  PairSender sender_;
  DepthSender depth_;
  PortGroup ports_;
  int first_port_ = 0;
  std::atomic<bool> stop_ = false;

  bool follows_ = true;  ///< whether the client took the last pair; used by the headset's thread

  mutable Mutex report_mutex_;
  ServerReport report_ ORTHONAV_GUARDED_BY(report_mutex_);
  std::thread network_;
  std::thread producer_;
};

}  // namespace

std::vector<std::string> ServerOptions::check() const {
  std::vector<std::string> problems = faults.check();
  if (first_port < 0 || first_port > 65535 - kStandinOffset) {
    problems.push_back("first_port must lie in [0, " + std::to_string(65535 - kStandinOffset) +
                       "]");
  }
  if (paced && !standin) {
    problems.push_back("paced needs standin");
  }
  if (slices < 1 || slices > kMaxSlices) {
    problems.push_back("slices must lie in [1, " + std::to_string(kMaxSlices) + "]");
  }
  if (unmapped_edge_px < 0 || unmapped_edge_px > kMaxUnmappedPx) {
    problems.push_back("unmapped_edge_px must lie in [0, " + std::to_string(kMaxUnmappedPx) + "]");
  }
  return problems;
}

Result<std::unique_ptr<Server>> Server::start(const ServerOptions& options, OpenHeadset open) {
  const auto problems = options.check();
  if (!problems.empty()) {
    return Error{"hl2ss server: " + joined(problems)};
  }
  const auto host = net::resolve(options.host);
  if (!host) {
    return Error{"hl2ss server: " + host.error().message, host.error().code};
  }
  const auto allowed = net::Allowed::of(options.allow);
  if (!allowed) {
    return Error{"hl2ss server: " + allowed.error().message};
  }
  if (const Status named = check_who_may(options.host, *host, *allowed); !named) {
    return Error{"hl2ss server: " + named.error().message};
  }
  auto first = open();
  if (!first) {
    return first.error();
  }
  auto server = std::make_unique<RunningServer>(options, std::move(open), std::move(*first));
  if (const Status listening = server->listen(*host, *allowed); !listening) {
    return Error{"hl2ss server: " + listening.error().message, listening.error().code};
  }
  server->run();
  return std::unique_ptr<Server>(std::move(server));
}

}  // namespace orthonav::hl2ss
