#include "hal/sim/cameras/sim_cameras.h"

#include <chrono>
#include <cmath>
#include <utility>

namespace orthonav::sim {
namespace {

/// From mid-exposure to the images in memory, in addition to half the exposure.
constexpr Duration kReadout = std::chrono::milliseconds(5);
/// The stream ends this long after the surgeon is done.
constexpr Duration kAfterDone = std::chrono::milliseconds(500);

void resize(GreyImage& image, const CameraModel& camera) {
  image.width_px = camera.width_px();
  image.height_px = camera.height_px();
  image.pixels.resize(static_cast<std::size_t>(image.width_px) *
                      static_cast<std::size_t>(image.height_px));
}

}  // namespace

SimCameras::SimCameras(SimRoom& room, const SimOptions& options, StereoCalibration reported,
                       StereoCalibration actual)
    : room_(room),
      options_(options),
      half_exposure_(from_seconds(0.5 * options.error_model.exposure_s)),
      reported_(std::move(reported)),
      states_(options.error_model.exposure_s > 0.0 ? 3 : 1) {
  if (options.render) {
    renderer_ = std::make_unique<StereoRenderer>(room.simulation.room(), options.error_model,
                                                 std::move(actual), options.seed);
  }
}

/// Frames are due at whole ticks of 100 ns, so that files keep their times.
Timestamp SimCameras::time_of(std::int64_t number) const {
  return kSimStart +
         Duration(100 * static_cast<std::int64_t>(std::floor(
                            static_cast<double>(number) * 1e7 / options_.frame_rate_hz + 0.5)));
}

Timestamp SimCameras::delivery_of(std::int64_t number) const {
  return time_of(number) + half_exposure_ + kReadout;
}

MayRepeat SimCameras::do_may_repeat() const {
  const ErrorModel& model = options_.error_model;
  return {!renderer_ || (model.shot_noise == 0.0 && model.read_noise_grey == 0.0),
          model.head_pose_noise_m == 0.0 && model.head_pose_noise_rad == 0.0};
}

Result<Next> SimCameras::do_next(StereoFrame& frame) {
  if (options_.pace == Pace::kRealtime) {
    const Timestamp now = room_.clock.now();
    if (delivery_of(number_) > now) {
      return Next::kNone;
    }
    // A late caller misses frames, as with a real camera.
    while (delivery_of(number_ + 1) <= now) {
      ++number_;
    }
  }
  const Timestamp time = time_of(number_);
  {
    const MutexLock lock(room_.mutex);
    const auto finished = room_.simulation.finished_at();
    if (seconds(time - kSimStart) > options_.limit_s ||
        (finished && time > *finished + kAfterDone)) {
      room_.ended = true;
      return Next::kEnd;
    }
    expose(time, frame);
  }
  render(frame);
  room_.clock.set(delivery_of(number_));
  ++number_;
  return Next::kFrame;
}

void SimCameras::expose(Timestamp time, StereoFrame& frame) {
  RoomSimulation& simulation = room_.simulation;
  simulation.advance(time + half_exposure_);
  const auto middle = static_cast<std::int64_t>(states_.size() / 2);
  for (std::size_t i = 0; i < states_.size(); ++i) {
    simulation.state_at(time + (static_cast<std::int64_t>(i) - middle) * half_exposure_,
                        states_[i]);
  }
  const Timestamp before = time - RoomSimulation::kStep;
  room_.head.add(number_, time, simulation.world_from_rig(time), before,
                 simulation.world_from_rig(before));
  room_.last_frame = time;
  frame.sequence = number_;
  frame.time = time;
  const auto head = room_.head.at(time);
  frame.world_from_rig = head.value;
  frame.head_covariance = head.covariance;
}

void SimCameras::render(StereoFrame& frame) {
  if (renderer_) {
    return renderer_->render(states_, number_, frame);
  }
  resize(frame.left, reported_.left);
  resize(frame.right, reported_.right);
}

}  // namespace orthonav::sim
