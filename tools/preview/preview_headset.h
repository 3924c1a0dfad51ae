#pragma once

#include "hal/api/forwarding_headset.h"
#include "tools/preview/gate.h"
#include "tools/preview/keyboard.h"

namespace orthonav::preview {

/// A headset whose pairs come through a gate and whose button and voice are shared with the
/// keyboard; everything else is the headset's own.
class PreviewHeadset : public ForwardingHeadset {
 public:
  /// All three must outlive it.
  PreviewHeadset(Headset& inner, Gate& gate, Keyboard& keyboard)
      : ForwardingHeadset(inner),
        cameras_(inner.cameras(), gate),
        clicker_(inner.clicker(), keyboard),
        voice_(inner.voice(), keyboard) {}

  [[nodiscard]] StereoCamera& cameras() override { return cameras_; }
  [[nodiscard]] Clicker& clicker() override { return clicker_; }
  [[nodiscard]] Voice& voice() override { return voice_; }
  /// Wall time that the newest pair took to be rendered, or read from a recording.
  [[nodiscard]] double camera_ms() const { return cameras_.camera_ms(); }
  /// Wall time since that pair was delivered.
  [[nodiscard]] double since_pair_ms() const { return cameras_.since_pair_ms(); }

 private:
  class GatedCameras : public ForwardingCamera {
   public:
    GatedCameras(StereoCamera& inner, Gate& gate) : ForwardingCamera(inner), gate_(gate) {}
    [[nodiscard]] double camera_ms() const { return camera_ms_; }
    [[nodiscard]] double since_pair_ms() const;

   private:
    Result<Next> do_next(StereoFrame& frame) override;

    Gate& gate_;
    double camera_ms_ = 0.0;
    Timestamp there_{};  ///< of the delivery, in wall time
  };

  GatedCameras cameras_;
  SharedClicker clicker_;
  SharedVoice voice_;
};

}  // namespace orthonav::preview
