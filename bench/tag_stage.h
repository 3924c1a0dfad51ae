#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/random.h"
#include "hal/api/devices.h"
#include "hal/sim/cameras/hololens2.h"
#include "hal/sim/cameras/room_renderer.h"

namespace orthonav::bench {

inline constexpr double kTagM = 0.040;

/// The conditions of a sequence.
struct TagKind {
  double speed = 1.0;  ///< of the hand; 1: about 0.15 m/s and 0.9 rad/s RMS
  double light = 1.0;
  double shot = 0.1;
  double read = 1.0;
  bool hand = false;
};

[[nodiscard]] TagKind tag_kind_of(const std::string& name);

/// The pointer and the guide.
[[nodiscard]] sim::RoomDescription tag_room();

/// The simulator draws for a left camera; any camera may stand in its place.
[[nodiscard]] Transform<LeftCamera, Rig> as_camera(const Transform<RightCamera, Rig>& right);

/// A smooth motion without a noticeable period: three sines per axis.
struct Wander {
  std::array<std::array<double, 3>, 6> phase{};
  explicit Wander(Random random);
  [[nodiscard]] double at(std::size_t axis, double t) const;
};

/// Two tools that hands move before a swaying head.
class TagStage {
 public:
  TagStage(const TagKind& kind, std::uint64_t seed);
  [[nodiscard]] sim::RoomState at(double t) const;
  void render(std::span<const sim::RoomState> states, StereoFrame& frame);
  /// The moments of an exposure about `t`.
  [[nodiscard]] std::vector<sim::RoomState> exposure(double t) const;
  [[nodiscard]] const StereoCalibration& calibration() const { return calibration_; }
  [[nodiscard]] const TagKind& kind() const { return kind_; }

 private:
  TagKind kind_;
  Wander head_;
  std::array<Wander, 2> hands_;
  StereoCalibration calibration_ = sim::hololens2_calibration();
  std::unique_ptr<sim::RoomRenderer> renderer_;
};

}  // namespace orthonav::bench
