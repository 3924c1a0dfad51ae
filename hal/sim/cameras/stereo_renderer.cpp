#include "hal/sim/cameras/stereo_renderer.h"

#include "base/random.h"

namespace orthonav::sim {

StereoRenderer::StereoRenderer(const RoomDescription& room, const ErrorModel& error_model,
                               StereoCalibration cameras, std::uint64_t seed)
    : cameras_(std::move(cameras)),
      seed_(seed),
      left_(RoomRenderer::create(room, error_model)),
      right_(RoomRenderer::create(room, error_model)),
      worker_([this] { work(); }) {}

StereoRenderer::~StereoRenderer() {
  {
    const MutexLock lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

void StereoRenderer::render(std::span<const RoomState> states, std::int64_t number,
                            StereoFrame& frame) {
  const Random noise = Random(seed_).fork("image").fork(static_cast<std::uint64_t>(number));
  {
    const MutexLock lock(mutex_);
    job_ = {states, noise.fork("right").next(), &frame.right};
  }
  changed_.notify_all();
  left_->render(states, cameras_.left, cameras_.left_from_rig, noise.fork("left").next(),
                frame.left);
  const MutexLock lock(mutex_);
  while (job_.image != nullptr) {
    changed_.wait(mutex_);
  }
}

void StereoRenderer::work() {
  // The renderer's type for any camera's pose is that of the left one.
  const Transform<LeftCamera, Rig> right_from_rig{cameras_.right_from_rig.rotation(),
                                                  cameras_.right_from_rig.translation()};
  for (;;) {
    Job job;
    {
      const MutexLock lock(mutex_);
      while (!stop_ && job_.image == nullptr) {
        changed_.wait(mutex_);
      }
      if (stop_) {
        return;
      }
      job = job_;
    }
    right_->render(job.states, cameras_.right, right_from_rig, job.noise_seed, *job.image);
    const MutexLock lock(mutex_);
    job_.image = nullptr;
    changed_.notify_all();
  }
}

}  // namespace orthonav::sim
