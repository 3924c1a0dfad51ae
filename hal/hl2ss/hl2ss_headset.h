#pragma once

#include <memory>
#include <string>

#include "hal/api/devices.h"
#include "hal/hl2ss/options.h"

namespace orthonav::hl2ss {

/// A HoloLens 2 over the network (docs/hl2ss.md). A pair's time is its left image's stamp on the
/// headset's boot clock, corrected for its lateness (`kResearchModeStampsLate`), its pose the left
/// packet's, at that time. When the connection is lost the head is lost,
/// no pairs come and `next` says so once; it is made again for as long as the headset lives.
///
/// The clicker has no events and the display shows nothing, unless a stand-in is connected.
class Hl2ssHeadset : public Headset {
 public:
  /// Blocks until both calibrations and a first image came, `open_within` at most; two seconds of
  /// it for the calibration of a depth camera, without which it opens all the same. An Error names
  /// the port that failed and why.
  static Result<std::unique_ptr<Hl2ssHeadset>> open(const Hl2ssOptions& options);
  /// Why there is no depth camera although one was asked for; empty otherwise. Nothing else depends
  /// on it.
  [[nodiscard]] virtual const std::string& depth_trouble() const = 0;
  /// How the connection does.
  [[nodiscard]] virtual ConnectionStatistics statistics() const = 0;
  [[nodiscard]] std::optional<ConnectionStatistics> connection() const final {
    return statistics();
  }
};

}  // namespace orthonav::hl2ss
