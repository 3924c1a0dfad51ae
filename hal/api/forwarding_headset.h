#pragma once

#include "hal/api/devices.h"

namespace orthonav {

/// Forwards to another headset, part by part; a base class for headsets that replace some parts.
/// Borrows the other headset.
class ForwardingHeadset : public Headset {
 public:
  explicit ForwardingHeadset(Headset& inner) : inner_(inner) {}
  [[nodiscard]] std::string name() const override { return inner_.name(); }
  [[nodiscard]] const Clock& clock() const override { return inner_.clock(); }
  [[nodiscard]] std::int64_t epoch_ticks_100ns() const override {
    return inner_.epoch_ticks_100ns();
  }
  [[nodiscard]] StereoCamera& cameras() override { return inner_.cameras(); }
  [[nodiscard]] HeadTracker& head() override { return inner_.head(); }
  [[nodiscard]] Clicker& clicker() override { return inner_.clicker(); }
  [[nodiscard]] Voice& voice() override { return inner_.voice(); }
  [[nodiscard]] Display& display() override { return inner_.display(); }
  [[nodiscard]] std::vector<DepthCamera*> depth_cameras() override {
    return inner_.depth_cameras();
  }
  [[nodiscard]] Microphone* microphone() override { return inner_.microphone(); }
  [[nodiscard]] PixelDisplay* pixels() override { return inner_.pixels(); }
  [[nodiscard]] ObjectDisplay* objects() override { return inner_.objects(); }
  [[nodiscard]] DescribedTools described_tools() const override { return inner_.described_tools(); }
  [[nodiscard]] std::optional<ConnectionStatistics> connection() const override {
    return inner_.connection();
  }

 private:
  Headset& inner_;
};

}  // namespace orthonav
