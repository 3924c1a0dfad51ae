#pragma once

#include <vector>

#include "engine/evaluation/shaft.h"

namespace orthonav::engine {

/// The voxels of metal that are not assigned yet.
class MetalCloud {
 public:
  explicit MetalCloud(const ScanField& scan);

  [[nodiscard]] const std::vector<Vec3>& places_m() const { return places_m_; }
  [[nodiscard]] double voxel_m3() const { return spacing_m_.x * spacing_m_.y * spacing_m_.z; }
  /// Half the extent of a voxel along a unit vector.
  [[nodiscard]] double half_extent_m(Vec3 direction) const;
  template <class Taken>
  void take(const Taken& taken) {
    std::erase_if(places_m_, taken);
  }

 private:
  std::vector<Vec3> places_m_;
  Vec3 spacing_m_;
  Mat3 directions_;
};

/// One cross section of metal about a line, a slab of `MetalSections::kStep_m`.
struct MetalSection {
  double area_m2 = 0.0;
  Vec2 middle_m;  ///< across and athwart
};

/// The cross sections about a line, from its middle to either side until a gap of more than 3 mm.
struct MetalSections {
  static constexpr double kStep_m = 0.001;
  double first_s_m = 0.0;  ///< middle of the first slab
  std::vector<MetalSection> slabs;

  [[nodiscard]] double s_m(std::size_t slab) const {
    return first_s_m + static_cast<double>(slab) * kStep_m;
  }
  [[nodiscard]] double radius_m(std::size_t slab) const;
};

/// The sections of the metal within `within_m` of the line.
[[nodiscard]] MetalSections sections_about(const MetalCloud& cloud, const Centreline& line,
                                           double within_m);

}  // namespace orthonav::engine
