#pragma once

#include <memory>
#include <string>

#include "hal/api/devices.h"
#include "hal/api/headset_scheme.h"
#include "hal/hl2ss/options.h"

namespace orthonav::hl2ss {

/// A HoloLens 2 over the network (docs/hl2ss.md). A pair's time is its left image's stamp on the
/// headset's boot clock, corrected for its lateness (`kResearchModeStampsLate`); its pose is the
/// left packet's, at that time. While the connection is lost, the head is lost and there are no
/// pairs; `next` reports it once. Reconnecting is tried for as long as this object exists.
///
/// The clicker has no events and the display shows nothing, except with a stand-in.
class Hl2ssHeadset : public Headset {
 public:
  /// Blocks until both calibrations and a first image have arrived, at most for `open_within`; of
  /// this, at most two seconds for the calibration of a depth camera, without which it opens
  /// anyway. An Error names the port that failed and why.
  static Result<std::unique_ptr<Hl2ssHeadset>> open(const Hl2ssOptions& options);
  /// Why there is no depth camera although one was requested; empty otherwise. Nothing else depends
  /// on it.
  [[nodiscard]] virtual const std::string& depth_trouble() const = 0;
  /// Statistics of the connection.
  [[nodiscard]] virtual ConnectionStatistics statistics() const = 0;
  [[nodiscard]] std::optional<ConnectionStatistics> connection() const final {
    return statistics();
  }
};

/// `hl2ss://HOST[?KEY=VALUE&...]` (`options_of`).
[[nodiscard]] HeadsetScheme scheme();

}  // namespace orthonav::hl2ss
