#include "hal/hl2ss/server/server.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "hal/api/joined.h"
#include "hal/hl2ss/calibration.h"
#include "hal/hl2ss/server/camera_port.h"
#include "hal/hl2ss/server/packets.h"
#include "hal/hl2ss/server/side_ports.h"
#include "hal/hl2ss/spatial_input.h"

namespace orthonav::hl2ss {
namespace {

constexpr int kTurnMs = 5;
constexpr auto kIdle = std::chrono::milliseconds(1);
/// A client that is not done with a pair by then missed it.
constexpr auto kPatience = std::chrono::seconds(2);
constexpr auto kImpatience = std::chrono::milliseconds(20);
/// Sensor ticks are another clock than the stamps, and the cameras' stamps differ a little.
constexpr std::int64_t kSensorTicksAhead = 7'654'321;
constexpr std::int64_t kRightLaterTicks = 1'500;
constexpr int kSamplesAPair = kMicrophoneHz / 30;
constexpr int kFirstFreePort = 20000;
constexpr int kPortStep = 20;

class RunningServer final : public Server {
 public:
  RunningServer(const ServerOptions& options, OpenHeadset open, std::unique_ptr<Headset> first)
      : options_(options),
        open_(std::move(open)),
        headset_(std::move(first)),
        left_(calibration_of(Side::kLeft), options.faults, Random(options.seed).fork("left")),
        right_(calibration_of(Side::kRight), options.faults, Random(options.seed).fork("right")),
        random_(Random(options.seed).fork("pairs")),
        sides_(options.utc_offset_ticks) {}
  ~RunningServer() override {
    stop_ = true;
    if (producer_.joinable()) producer_.join();
    if (network_.joinable()) network_.join();
  }

  Status listen(const Endpoint& host) {
    for (int base = options_.first_port > 0 ? options_.first_port : kFirstFreePort;;
         base += kPortStep) {
      const Status listening = listen_from(host, base);
      if (listening) return {};
      const bool may_look_on = options_.first_port == 0 && base < 60000;
      if (!may_look_on) return listening;
    }
  }
  void run() {
    network_ = std::thread([this] { serve(); });
    producer_ = std::thread([this] { produce(); });
  }
  [[nodiscard]] int first_port() const override { return first_port_; }
  [[nodiscard]] int standin_port() const override { return first_port_ + kStandinOffset; }
  [[nodiscard]] ServerReport report() const override {
    const std::lock_guard lock(report_mutex_);
    return report_;
  }

 private:
  enum class Side { kLeft, kRight };
  [[nodiscard]] std::vector<std::uint8_t> calibration_of(Side side) const {
    const StereoCalibration& c = headset_->cameras().calibration();
    return side == Side::kLeft ? calibration_bytes(c.left, c.left_from_rig.row_major())
                               : calibration_bytes(c.right, c.right_from_rig.row_major());
  }

  std::vector<std::pair<Port*, int>> ports() {
    std::vector<std::pair<Port*, int>> all = {
        {&left_.port(), offset_of(Service::kLeftFront)},
        {&right_.port(), offset_of(Service::kRightFront)},
        {&sides_.configuration, offset_of(Service::kConfiguration)},
        {&sides_.microphone, offset_of(Service::kMicrophone)},
        {&sides_.spatial, offset_of(Service::kSpatialInput)},
        {&sides_.voice, offset_of(Service::kVoice)}};
    if (options_.standin) all.emplace_back(&sides_.standin, kStandinOffset);
    return all;
  }
  Status listen_from(const Endpoint& host, int base) {
    for (const auto& [port, offset] : ports())
      if (const Status listening = port->listen(host, base + offset); !listening) return listening;
    first_port_ = base;
    return {};
  }

  /// The network's thread.
  void serve() {
    std::vector<pollfd> watched;
    const auto all = ports();
    while (!stop_) {
      watched.clear();
      for (const auto& [port, offset] : all) watched.push_back({port->fd(), port->events(), 0});
      (void)::poll(watched.data(), watched.size(), kTurnMs);
      const HostTime now = HostClock::now();
      for (std::size_t i = 0; i < all.size(); ++i) all[i].first->step(watched[i].revents, now);
      show();
    }
  }
  /// What the client shows, the wearer sees.
  void show() {
    for (ShownFrame& frame : sides_.take_shown()) {
      const std::lock_guard lock(headset_mutex_);
      for (ShownHologram& hologram : frame.holograms)
        for (Point<World>& point : hologram.points_in_world) point = world_from_jumped_ * point;
      if (headset_ && in_session_) (void)headset_->display().shown(frame);
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
      if (begin_session()) run_session();
      end_session();
    }
  }
  bool begin_session() {
    const std::lock_guard lock(headset_mutex_);
    if (!headset_) {
      auto opened = open_();
      if (!opened) {
        note([&](ServerReport& report) { report.last_trouble = opened.error().message; });
        return false;
      }
      headset_ = std::move(*opened);
    }
    in_session_ = true;
    jumped_from_world_ = {};
    world_from_jumped_ = Transform<World, World>{};
    pairs_ = 0;
    note([](ServerReport& report) {
      ++report.sessions;
      report.is_streaming = true;
    });
    const Timestamp now = headset_->clock().now();
    const Duration latency = headset_->display().predicted_display_time(now) - now;
    sides_.greet({options_.paced, latency, now});
    return true;
  }
  void end_session() {
    {
      const std::lock_guard lock(headset_mutex_);
      in_session_ = false;
      headset_.reset();
    }
    note([](ServerReport& report) { report.is_streaming = false; });
    sides_.end();
    while (!stop_ && (left_.is_streaming() || right_.is_streaming()))
      std::this_thread::sleep_for(kIdle);
  }
  void run_session() {
    StereoFrame frame;
    auto gone_since = HostClock::now();
    while (!stop_) {
      // A client may come back; for one that does not, nothing goes on.
      if (left_.port().has_client() || right_.port().has_client()) gone_since = HostClock::now();
      if (HostClock::now() - gone_since > kPatience) return;
      const auto next = headset_->cameras().next(frame);
      if (next && *next == Next::kEnd) return;
      if (!next || *next == Next::kNone) {
        std::this_thread::sleep_for(kIdle);
        continue;
      }
      const bool whole = send_pair(frame);
      if (!options_.paced) continue;
      wait_for_client(whole ? std::optional(frame.time) : std::nullopt);
    }
  }
  /// Until it is done with the pair, or is back. One that missed a pair (a codec may need more to
  /// go on) is not waited for long until it follows again.
  void wait_for_client(std::optional<Timestamp> pair_time) {
    const auto deadline = HostClock::now() + (follows_ ? kPatience : kImpatience);
    const auto waits = [&] { return !is_wanted() || (pair_time && !sides_.took(*pair_time)); };
    while (!stop_ && waits() && HostClock::now() < deadline) sides_.wait_for_took();
    if (pair_time) follows_ = !waits();
  }

  /// Whether all of it was sent whole and at once.
  bool send_pair(const StereoFrame& frame) {
    const std::int64_t number = pairs_++;
    note([](ServerReport& report) { ++report.pairs; });
    if (std::count(options_.faults.jump_at.begin(), options_.faults.jump_at.end(), number) > 0)
      jump();
    send_events(frame);
    const bool gap = strikes(options_.faults.gap);
    const bool unlocated = strikes(options_.faults.unlocated);
    if (gap) return false;
    CameraPort::Image image;
    image.ticks = ticks_100ns(frame.time);
    image.sensor_ticks = static_cast<std::uint64_t>(image.ticks + kSensorTicksAhead);
    image.picture = &frame.left;
    // The first images open the connection: they come as they are.
    image.spoil = number > 2;
    if (frame.world_from_rig && !unlocated)
      image.world_from_rig = jumped_from_world_ * *frame.world_from_rig;
    bool whole = send_image(left_, image);
    image.ticks += kRightLaterTicks;
    image.picture = &frame.right;
    whole = send_image(right_, image) && whole;
    note([&](ServerReport& report) {
      report.faults = struck_ + left_.faults_done() + right_.faults_done();
    });
    return whole;
  }
  bool send_image(CameraPort& camera, const CameraPort::Image& image) {
    const auto sent = camera.send(image);
    if (!sent) note([&](ServerReport& report) { report.last_trouble = sent.error().message; });
    return sent && *sent;
  }
  void send_events(const StereoFrame& frame) {
    std::vector<ClickerEvent> clicks;
    std::vector<Phrase> phrases;
    (void)headset_->clicker().poll(frame.time, clicks);
    (void)headset_->voice().poll(frame.time, phrases);
    sides_.tell(clicks, phrases, {frame.time, headset_->clock().now()});
    const std::int64_t ticks = ticks_100ns(frame.time);
    // Two packets a pair, as on the headset. The head is the rig here: nobody navigates by it.
    std::optional<Transform<World, Eye>> head;
    if (frame.world_from_rig) {
      const auto pose = jumped_from_world_ * *frame.world_from_rig;
      head = Transform<World, Eye>(pose.rotation(), pose.translation());
    }
    for (const std::int64_t later : {0, 166'667})
      sides_.spatial.send({{packet_bytes(ticks + later, spatial_input_bytes(head))}});
    if (sides_.hears.load())
      sides_.microphone.send(
          {{packet_bytes(ticks, tone_bytes(kSamplesAPair * pairs_, kSamplesAPair))}});
  }
  void jump() {
    const Faults& faults = options_.faults;
    jumped_from_world_ =
        Transform<World, World>(rotation_from_vector({0, faults.jump_rad, 0}), faults.jump_m) *
        jumped_from_world_;
    const std::lock_guard lock(headset_mutex_);
    world_from_jumped_ = jumped_from_world_.inverse();
    ++struck_;
  }
  bool strikes(double probability) {
    const bool strike = pairs_ > 3 && random_.uniform() < probability;
    struck_ += strike ? 1 : 0;
    return strike;
  }
  void note(auto what) {
    const std::lock_guard lock(report_mutex_);
    what(report_);
  }

  ServerOptions options_;
  OpenHeadset open_;
  std::mutex headset_mutex_;  ///< of its coming and going; its parts may be used from two threads
  std::unique_ptr<Headset> headset_;
  bool in_session_ = false;
  Transform<World, World> world_from_jumped_;
  CameraPort left_;
  CameraPort right_;
  Random random_;
  SidePorts sides_;
  int first_port_ = 0;
  std::atomic<bool> stop_ = false;

  // Of the headset's thread.
  Transform<World, World> jumped_from_world_;
  std::int64_t pairs_ = 0;
  std::int64_t struck_ = 0;
  bool follows_ = true;

  mutable std::mutex report_mutex_;
  ServerReport report_;
  std::thread network_;
  std::thread producer_;
};

}  // namespace

std::vector<std::string> ServerOptions::check() const {
  std::vector<std::string> problems = faults.check();
  if (first_port < 0 || first_port > 65535 - kStandinOffset)
    problems.push_back("first_port must lie in [0, " + std::to_string(65535 - kStandinOffset) +
                       "]");
  if (paced && !standin) problems.push_back("paced needs standin");
  if (utc_offset_ticks < 0) problems.push_back("utc_offset_ticks must not be negative");
  return problems;
}

Result<std::unique_ptr<Server>> Server::start(const ServerOptions& options, OpenHeadset open) {
  const auto problems = options.check();
  if (!problems.empty()) return Error{"hl2ss server: " + joined(problems)};
  const auto host = resolve(options.host);
  if (!host) return Error{"hl2ss server: " + host.error().message};
  auto first = open();
  if (!first) return first.error();
  auto server = std::make_unique<RunningServer>(options, std::move(open), std::move(*first));
  if (const Status listening = server->listen(*host); !listening)
    return Error{"hl2ss server: " + listening.error().message};
  server->run();
  return std::unique_ptr<Server>(std::move(server));
}

}  // namespace orthonav::hl2ss
