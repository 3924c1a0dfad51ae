#include "hal/hl2ss/server/served_headset.h"

#include <utility>

#include "hal/hl2ss/calibration.h"
#include "hal/hl2ss/server/depth_bytes.h"

namespace orthonav::hl2ss {
std::vector<std::uint8_t> ServedHeadset::left_calibration(int unmapped_edge_px) const {
  const MutexLock lock(mutex_);
  const StereoCalibration& cameras = headset_->cameras()->calibration();
  auto bytes = calibration_bytes(cameras.left, cameras.left_from_rig.row_major());
  unmap_edges(bytes, unmapped_edge_px);
  return bytes;
}

std::vector<std::uint8_t> ServedHeadset::right_calibration(int unmapped_edge_px) const {
  const MutexLock lock(mutex_);
  const StereoCalibration& cameras = headset_->cameras()->calibration();
  auto bytes = calibration_bytes(cameras.right, cameras.right_from_rig.row_major());
  unmap_edges(bytes, unmapped_edge_px);
  return bytes;
}

std::vector<std::uint8_t> ServedHeadset::depth_calibration(DepthStream stream) const {
  const MutexLock lock(mutex_);
  for (const DepthCamera* camera : headset_->depth_cameras()) {
    if (camera->calibration().stream == stream) {
      return depth_answer_bytes(camera->calibration());
    }
  }
  return {};
}

Result<Headset*> ServedHeadset::begin_session(const std::function<void(Headset&)>& prepare) {
  const MutexLock lock(mutex_);
  if (!headset_) {
    auto opened = open_();
    if (!opened) {
      return opened.error();
    }
    headset_ = std::move(*opened);
  }
  in_session_ = true;
  prepare(*headset_);
  return headset_.get();
}

void ServedHeadset::end_session() {
  const MutexLock lock(mutex_);
  in_session_ = false;
  headset_.reset();
}

void ServedHeadset::show(const Transform<World, World>& back, WornFrame& frame) {
  const MutexLock lock(mutex_);
  frame.wearer_from_drawn = back * frame.wearer_from_drawn;
  if (headset_ && in_session_ && headset_->wearer()) {
    headset_->wearer()->see(frame);
  }
}

}  // namespace orthonav::hl2ss
