#pragma once

#include <array>
#include <optional>

#include "base/tracked.h"
#include "base/transform.h"
#include "hal/sim/error_model.h"
#include "hal/sim/room/noise.h"

namespace orthonav::sim {

/// What the headset reports of its own pose: a noisy measurement at every frame, interpolated in
/// between, and extrapolated from the newest with its velocity (which an inertial sensor measures
/// well). Remembers 256 frames. Not thread-safe.
class HeadTrack {
 public:
  /// The covariance that it states is of SDs `told_sd_factor` times those of its noise.
  HeadTrack(const Random& random, const ErrorModel& error_model, double told_sd_factor);
  /// The true poses at a frame and a moment before it.
  void add(std::int64_t frame, Timestamp time, const Transform<World, Rig>& pose, Timestamp before,
           const Transform<World, Rig>& pose_before);
  [[nodiscard]] std::optional<Timestamp> newest() const;
  [[nodiscard]] Tracked<Transform<World, Rig>> at(Timestamp time) const;
  /// The answer that would have been given when `known` was the newest measurement.
  [[nodiscard]] Tracked<Transform<World, Rig>> at(Timestamp time, Timestamp known) const;
  /// From where the head's reported pose puts what is seen in the frame at that time to where it
  /// is; the identity for a frame that is not remembered.
  [[nodiscard]] Transform<World, World> actual_from_reported(Timestamp frame) const;

 private:
  struct Node {
    Timestamp time{};
    Timestamp before{};
    Transform<World, Rig> pose;  ///< true
    Transform<World, Rig> pose_before;
    Vec3 translation_m;
    Vec3 rotation_rad;
  };
  static constexpr std::size_t kKept = 256;
  [[nodiscard]] const Node& back(std::size_t steps) const {
    return nodes_[(count_ - 1 - steps) % kKept];
  }
  [[nodiscard]] static Transform<World, Rig> noisy(const Node& node,
                                                   const Transform<World, Rig>& pose);

  Random random_;
  double noise_m_;
  double noise_rad_;
  double told_variance_factor_;
  double fresh_ = 1.0;  ///< the part of the noise's SD that is new in every frame
  SmoothNoise3 lasting_m_;
  SmoothNoise3 lasting_rad_;
  std::array<Node, kKept> nodes_;
  std::size_t count_ = 0;
};

}  // namespace orthonav::sim
