#include "hal/sim/room/surface_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vertex_normals.h"
#include "hal/sim/room/noise.h"

namespace orthonav::sim {

SurfaceField::SurfaceField(Random random, double sd, double length_m)
    : amplitude_(length_m > 0.0 ? sd * std::sqrt(2.0 / static_cast<double>(kWaves)) : 0.0) {
  for (std::size_t i = 0; i < kWaves && amplitude_ != 0.0; ++i) {
    // The correlation at distance `length_m` is exp(-1/2).
    wave_[i] = normal_vector(random, 1.0 / length_m);
    phase_[i] = 2.0 * std::numbers::pi * random.uniform();
  }
}

double SurfaceField::at(Vec3 place) const {
  if (amplitude_ == 0.0) {
    return 0.0;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < kWaves; ++i) {
    sum += std::sin(wave_[i].dot(place) + phase_[i]);
  }
  return amplitude_ * sum;
}

std::array<std::uint32_t, 4> extremes_of(const RoomLevel& level) {
  constexpr std::array<Vec3, 4> kDirections = {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{-1, 0, 0},
                                               Vec3{0, 0, 1}};
  std::array<std::uint32_t, 4> found{};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto extreme =
        std::max_element(level.vertices_m.begin(), level.vertices_m.end(),
                         [d = kDirections[i]](Vec3 a, Vec3 b) { return a.dot(d) < b.dot(d); });
    found[i] = static_cast<std::uint32_t>(extreme - level.vertices_m.begin());
  }
  return found;
}

RoomDescription with_bones_off_their_models(RoomDescription models, const ErrorModel& error_model,
                                            const Random& random) {
  if (error_model.model_error_m == 0.0) {
    return models;
  }
  for (RoomLevel& level : models.levels) {
    level.extremes = extremes_of(level);
    const SurfaceField off(random.fork(level.label), error_model.model_error_m,
                           error_model.model_error_length_m);
    const std::vector<Vec3> areas_m2 = vertex_areas_m2(level.vertices_m, level.triangles);
    for (std::size_t i = 0; i < areas_m2.size(); ++i) {
      const double area_m2 = areas_m2[i].norm();
      if (area_m2 > 0.0) {
        const Vec3 place = level.vertices_m[i];
        level.vertices_m[i] += off.at(place) / area_m2 * areas_m2[i];
      }
    }
  }
  return models;
}

}  // namespace orthonav::sim
