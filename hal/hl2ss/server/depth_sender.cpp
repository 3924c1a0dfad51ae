#include "hal/hl2ss/server/depth_sender.h"

#include <utility>

namespace orthonav::hl2ss {
namespace {

constexpr auto kDepthIdle = std::chrono::milliseconds(2);

}  // namespace

DepthSender::~DepthSender() {
  stop_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
}

void DepthSender::start(ClientFromWorld client_from_world, bool follows_pairs) {
  client_from_world_ = std::move(client_from_world);
  if (!follows_pairs) {
    thread_ = std::thread([this] { run(); });
  }
}

void DepthSender::begin(Headset& headset) {
  const MutexLock lock(mutex_);
  headset_ = &headset;
}

void DepthSender::end() {
  const MutexLock lock(mutex_);
  headset_ = nullptr;
}

void DepthSender::run() {
  while (!stop_) {
    (void)send_next();
    // Even when the next picture is due: `end` may be waiting for the mutex.
    std::this_thread::sleep_for(kDepthIdle);
  }
}

void DepthSender::send_due() {
  while (send_next()) {
  }
}

bool DepthSender::send_next() {
  const MutexLock lock(mutex_);
  const bool sent_ahat = send_next(ahat_);
  const bool sent_long_throw = send_next(long_throw_);
  return sent_ahat || sent_long_throw;
}

bool DepthSender::send_next(DepthPort& port) {
  if (headset_ == nullptr || !port.is_streaming()) {
    return false;
  }
  for (DepthCamera* camera : headset_->depth_cameras()) {
    if (camera->calibration().stream != port.stream()) {
      continue;
    }
    const auto next = camera->next(frame_);
    if (!next || *next != Next::kFrame) {
      continue;
    }
    if (frame_.world_from_rig) {
      frame_.world_from_rig = client_from_world_() * *frame_.world_from_rig;
    }
    (void)port.send(frame_);
    return true;
  }
  return false;
}

}  // namespace orthonav::hl2ss
