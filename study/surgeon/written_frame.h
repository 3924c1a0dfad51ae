#pragma once

#include "base/result.h"
#include "engine/live/frame_loop.h"
#include "engine/session/shown_frame.h"
#include "hal/api/wearer.h"

namespace orthonav::sim {

/// What is shown, for a simulated wearer.
[[nodiscard]] WornFrame written(const engine::ShownFrame& shown);
/// The same as it comes to the wearer, with its points in their World. An Error for bytes that
/// `written` does not make.
[[nodiscard]] Result<engine::ShownFrame> shown_in(const WornFrame& frame);

/// Passes on what a loop shows to the simulated wearer of its headset, if there is one.
class ShownToWearer : public engine::LoopObserver {
 public:
  /// The headset must outlive it.
  explicit ShownToWearer(Headset& headset) : wearer_(headset.wearer()) {}
  void shown(const engine::ShownFrame& frame) override {
    if (wearer_ != nullptr) {
      wearer_->see(written(frame));
    }
  }

 private:
  Wearer* wearer_;
};

}  // namespace orthonav::sim
