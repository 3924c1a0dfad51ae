// A headset that lives outside of orthonav: the least that one must do. It shows an empty room at
// 30 pairs a second for as many pairs as its URI says: "skeleton:90".
#pragma once

#include <string>
#include <vector>

#include "hal/api/devices.h"

class SkeletonDevice : public orthonav::Headset,
                       orthonav::Clock,
                       orthonav::StereoCamera,
                       orthonav::HeadTracker,
                       orthonav::Clicker,
                       orthonav::Voice,
                       orthonav::Display {
 public:
  SkeletonDevice(orthonav::StereoCalibration calibration, int pairs)
      : calibration_(std::move(calibration)), pairs_(pairs) {}
  [[nodiscard]] std::string name() const override { return "skeleton"; }
  [[nodiscard]] const orthonav::Clock& clock() const override { return *this; }
  [[nodiscard]] orthonav::StereoCamera& cameras() override { return *this; }
  [[nodiscard]] orthonav::HeadTracker& head() override { return *this; }
  [[nodiscard]] orthonav::Clicker& clicker() override { return *this; }
  [[nodiscard]] orthonav::Voice& voice() override { return *this; }
  [[nodiscard]] orthonav::Display& display() override { return *this; }

 private:
  [[nodiscard]] orthonav::Timestamp now() const override {
    return orthonav::Timestamp{} + next_ * std::chrono::microseconds(33333);
  }
  [[nodiscard]] const orthonav::StereoCalibration& do_calibration() const override {
    return calibration_;
  }
  orthonav::Result<orthonav::Next> do_next(orthonav::StereoFrame& frame) override {
    if (next_ == pairs_) {
      return orthonav::Next::kEnd;
    }
    frame.sequence = next_++;
    frame.time = now();
    frame.left = {calibration_.left.width_px(), calibration_.left.height_px()};
    frame.right = {calibration_.right.width_px(), calibration_.right.height_px()};
    frame.world_from_rig = orthonav::Transform<orthonav::World, orthonav::Rig>{};
    return orthonav::Next::kFrame;
  }
  [[nodiscard]] orthonav::Tracked<orthonav::Transform<orthonav::World, orthonav::Rig>>
  do_world_from_rig(orthonav::Timestamp at) const override {
    return {
        {}, at, at <= now() ? orthonav::PoseStatus::kMeasured : orthonav::PoseStatus::kPredicted};
  }
  orthonav::Status do_poll(orthonav::Timestamp, std::vector<orthonav::ClickerEvent>&) override {
    return {};
  }
  orthonav::Status do_poll(orthonav::Timestamp, std::vector<orthonav::Phrase>&) override {
    return {};
  }
  [[nodiscard]] orthonav::Duration do_latency() const override {
    return std::chrono::milliseconds(16);
  }
  orthonav::Status do_shown(const orthonav::ShownFrame&) override { return {}; }

  orthonav::StereoCalibration calibration_;
  int pairs_;
  int next_ = 0;
};
