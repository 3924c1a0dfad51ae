#include "hal/hl2ss/depth_receiver.h"

#include <array>
#include <string>
#include <utility>

#include "base/guarded.h"
#include "hal/hl2ss/receiver.h"

namespace orthonav::hl2ss {
namespace {

constexpr int kDepthTurnMs = 10;
/// Long throw may send only one picture per second.
constexpr Duration kDepthSilence = std::chrono::seconds(5);
/// A stand-in that waits for its client may be silent for as long as the client computes.
constexpr Duration kPacedDepthSilence = std::chrono::minutes(2);

}  // namespace

DepthReceiver::DepthReceiver(DepthDescription described, const Receiver& cameras, Duration interval)
    : described_(std::move(described)),
      cameras_(cameras),
      meter_(std::string("depth ") + name_of(described_.camera.stream), interval) {}

Result<std::unique_ptr<DepthReceiver>> DepthReceiver::start(const net::Endpoint& host,
                                                            const Hl2ssOptions& options,
                                                            DepthDescription described,
                                                            const Receiver& cameras) {
  const DepthFormat format = format_of(options.depth->stream);
  auto receiver = std::unique_ptr<DepthReceiver>(
      new DepthReceiver(std::move(described), cameras, format.interval));
  DepthReceiver& self = *receiver;
  {
    const MutexLock lock(self.mutex_);
    auto reader = DepthReader::create(*options.depth, options.bitrate, self.described_, self,
                                      self.meter_, self.pictures_);
    if (!reader) {
      return reader.error();
    }
    self.reader_ = std::move(*reader);
    const Duration silence = options.standin_port > 0 ? kPacedDepthSilence : kDepthSilence;
    self.connection_ = std::make_unique<Connection>(
        host, Connection::Options{options.first_port + offset_of(format.service), silence},
        self.meter_, *self.reader_);
  }
  self.thread_ = std::thread([&self] {
    const Status died = guarded("hl2ss depth", [&self] { self.run(); });
    if (!died) {
      const MutexLock lock(self.mutex_);
      self.meter_.trouble(died.error().message);
    }
  });
  return receiver;
}

DepthReceiver::~DepthReceiver() {
  stop_ = true;
  wake_up_.wake();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void DepthReceiver::run() {
  while (!stop_) {
    std::array<pollfd, 2> watched{};
    watched[0] = {wake_up_.fd(), POLLIN, 0};
    {
      const MutexLock lock(mutex_);
      watched[1] = {connection_->fd(), connection_->events(), 0};
    }
    net::wait_for_news(watched, kDepthTurnMs);
    if (watched[0].revents != 0) {
      wake_up_.clear();
    }
    const MutexLock lock(mutex_);
    connection_->step(watched[1].revents, HostClock::now());
  }
}

Result<Timestamp> DepthReceiver::told(std::uint64_t ticks, HostTime at) const {
  return cameras_.time_of(ticks, at);
}

StreamStatistics DepthReceiver::statistics() const {
  const MutexLock lock(mutex_);
  return meter_.statistics();
}

Result<Next> DepthReceiver::Camera::do_next(DepthFrame& frame) {
  const Receiver& cameras = receiver_.cameras_;
  if (!receiver_.pictures_.take(cameras.clock().now(), frame)) {
    return cameras.has_ended() ? Next::kEnd : Next::kNone;
  }
  frame.map_epoch = cameras.place(frame.time, frame.world_from_rig);
  return Next::kFrame;
}

}  // namespace orthonav::hl2ss
