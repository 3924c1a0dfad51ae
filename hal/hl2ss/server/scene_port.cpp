#include "hal/hl2ss/server/scene_port.h"

#include <utility>

namespace orthonav::hl2ss {
namespace {

constexpr Duration kFrame = std::chrono::microseconds(16'667);
constexpr Duration kSceneStall = std::chrono::seconds(1);
constexpr std::uint32_t kNonsense = 7;

}  // namespace

Result<std::size_t> ScenePort::understand(Bytes said) {
  const auto message = read_scene_message(said);
  if (!message) {
    return message.error();
  }
  if (!*message) {
    return std::size_t{0};
  }
  const MutexLock lock(mutex_);
  scene_.add(**message);
  return (*message)->bytes;
}

void ScenePort::left() {
  const MutexLock lock(mutex_);
  scene_.client_left();
  gone_ = true;
}

/// Intentional faults, drawn once per frame in which there is something to do.
void ScenePort::inject(HostTime now) {
  if (scene_.is_idle()) {
    return;
  }
  if (random_.uniform() < faults_.scene_stall) {
    stalled_until_ = now + kSceneStall;
  }
  if (random_.uniform() < faults_.scene_refuse) {
    scene_.refuse_next(1);
  }
  if (random_.uniform() < faults_.scene_cut) {
    cut_ = true;
  }
}

void ScenePort::run(HostTime now) {
  if (now < next_frame_) {
    return;
  }
  next_frame_ = now - next_frame_ > kFrame ? now + kFrame : next_frame_ + kFrame;
  std::vector<std::uint32_t> answers;
  {
    const MutexLock lock(mutex_);
    inject(now);
    if (suspended_ || now < stalled_until_) {
      return;
    }
    scene_.run_frame(answers);
    // The next client waits until the last one's queue is empty.
    gone_ = gone_ && !scene_.is_idle();
  }
  if (cut_.exchange(false)) {
    port.send({{{}, {}, true}});
  }
  answer(answers);
}

void ScenePort::answer(const std::vector<std::uint32_t>& answers) {
  if (answers.empty()) {
    return;
  }
  std::vector<std::uint8_t> bytes;
  for (const std::uint32_t each : answers) {
    append(bytes, nonsense_ ? kNonsense : each);
  }
  port.send({{std::move(bytes)}});
}

void ScenePort::refuse(int commands) {
  const MutexLock lock(mutex_);
  scene_.refuse_next(commands);
}

UnityObjects ScenePort::objects() const {
  const MutexLock lock(mutex_);
  return scene_.objects();
}

bool ScenePort::is_free() const {
  const MutexLock lock(mutex_);
  return !gone_;
}

}  // namespace orthonav::hl2ss
