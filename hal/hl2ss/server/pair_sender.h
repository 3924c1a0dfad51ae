#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/mutex.h"
#include "base/random.h"
#include "hal/api/devices.h"
#include "hal/hl2ss/server/camera_port.h"
#include "hal/hl2ss/server/side_ports.h"

namespace orthonav::hl2ss {

/// Sends a headset's data up to a pair through all ports, in a world that may jump. For one thread,
/// except `world_from_jumped`.
class PairSender {
 public:
  PairSender(const Faults& faults, std::uint64_t seed, CameraPort& left, CameraPort& right,
             SidePorts& sides)
      : faults_(faults),
        random_(Random(seed).fork("pairs")),
        left_(left),
        right_(right),
        sides_(sides) {}
  /// A new session begins.
  void restart();
  /// Whether all of it will arrive whole and rightly stamped.
  Result<bool> send(Headset& headset, const StereoFrame& frame);
  /// Converts the client's positions back to the headset's own.
  [[nodiscard]] Transform<World, World> world_from_jumped() const;
  /// Number of intentional faults so far, including those of the cameras' ports.
  [[nodiscard]] std::int64_t faults_done() const;

 private:
  [[nodiscard]] Transform<World, World> jumped_from_world() const;
  [[nodiscard]] std::optional<Transform<World, Rig>> world_from_rig(Headset& headset,
                                                                    const StereoFrame& frame,
                                                                    Duration after) const;
  void send_events(Headset& headset, const StereoFrame& frame);
  void jump();
  bool strikes(double probability);
  /// Whether a fault from that pair on strikes this one.
  bool strikes(const std::optional<std::int64_t>& from);

  Faults faults_;
  Random random_;
  CameraPort& left_;
  CameraPort& right_;
  SidePorts& sides_;
  std::int64_t pairs_ = 0;
  std::int64_t struck_ = 0;
  GreyImage frozen_left_;
  GreyImage frozen_right_;
  GreyImage last_right_;
  std::optional<Transform<World, Rig>> frozen_pose_;
  Duration back_{};  ///< by which the headset's clock is set back
  mutable Mutex mutex_;
  Transform<World, World> jumped_from_world_ ORTHONAV_GUARDED_BY(mutex_);
};

}  // namespace orthonav::hl2ss
