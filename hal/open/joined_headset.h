#pragma once

#include <memory>
#include <string>

#include "hal/api/devices.h"

namespace orthonav {

/// Parts that take the place of a headset's own; null: its own.
struct OtherParts {
  std::unique_ptr<Clicker> clicker;
  std::unique_ptr<Voice> voice;
};

/// A headset with a clicker or a voice from elsewhere. Borrows the headset; everything else is
/// passed through, the name too, which tells a journal which cameras were used.
class JoinedHeadset : public Headset {
 public:
  JoinedHeadset(Headset& headset, OtherParts parts) : headset_(headset), parts_(std::move(parts)) {}
  [[nodiscard]] std::string name() const override { return headset_.name(); }
  [[nodiscard]] const Clock& clock() const override { return headset_.clock(); }
  [[nodiscard]] std::int64_t epoch_ticks_100ns() const override {
    return headset_.epoch_ticks_100ns();
  }
  [[nodiscard]] StereoCamera& cameras() override { return headset_.cameras(); }
  [[nodiscard]] HeadTracker& head() override { return headset_.head(); }
  [[nodiscard]] Clicker& clicker() override {
    return parts_.clicker ? *parts_.clicker : headset_.clicker();
  }
  [[nodiscard]] Voice& voice() override { return parts_.voice ? *parts_.voice : headset_.voice(); }
  [[nodiscard]] Display& display() override { return headset_.display(); }
  [[nodiscard]] Microphone* microphone() override { return headset_.microphone(); }
  [[nodiscard]] PixelDisplay* pixels() override { return headset_.pixels(); }
  [[nodiscard]] Headset& owner_of_cameras() override { return headset_.owner_of_cameras(); }

 private:
  Headset& headset_;
  OtherParts parts_;
};

}  // namespace orthonav
