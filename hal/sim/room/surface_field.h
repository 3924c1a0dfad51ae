#pragma once

#include <array>

#include "base/random.h"
#include "base/vec.h"
#include "hal/sim/error_model.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// A smooth random function of a place: a sum of plane waves with random directions and phases
/// (Shinozuka 1971), with wavelengths of about the correlation length. Stationary, with the given
/// SD over space.
class SurfaceField {
 public:
  SurfaceField(Random random, double sd, double length_m);
  [[nodiscard]] double at(Vec3 place) const;

 private:
  static constexpr std::size_t kWaves = 32;
  double amplitude_ = 0.0;
  std::array<Vec3, kWaves> wave_{};
  std::array<double, kWaves> phase_{};
};

/// The true bones for segmented models: displaced along the normal by a field of `model_error_m`.
[[nodiscard]] RoomDescription with_bones_off_their_models(RoomDescription models,
                                                          const ErrorModel& error_model,
                                                          const Random& random);

}  // namespace orthonav::sim
