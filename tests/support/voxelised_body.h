#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "nav/geometry/mesh.h"

namespace orthonav::test {

/// A rigid motion in plain numbers: place = rotation * model + translation.
struct Motion {
  Mat3 rotation = Mat3::identity();
  Vec3 translation_m;
  [[nodiscard]] Vec3 operator()(Vec3 v_m) const { return rotation * v_m + translation_m; }
};

/// Metal as a cylinder with flat ends; a ball where both are the same place.
struct MetalPiece {
  Vec3 from_m;
  Vec3 to_m;
  double radius_m = 0.0;
  double hu = 8000.0;  ///< titanium at 120 kV; steel has twice as much
};

/// A bone at its place in the scanner.
struct BodyBone {
  nav::TriangleMesh mesh;
  Motion scanner_from_model;
};

/// Cells in three directions, the first fastest in memory.
struct Cells {
  std::array<int, 3> size{};

  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  [[nodiscard]] bool holds(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
  }
  [[nodiscard]] std::size_t at(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(i);
  }
};

/// The contents of the scanner, on a fine grid of `step_m`: bone with a cortex over cancellous
/// bone, soft tissue with some texture, metal by its share of each cell. Shares no method with the
/// search for metal in scans (engine/evaluation): bones are filled between the crossings of columns
/// with the surface, the cortex comes from a chamfer distance, and metal is analytic.
struct FineBody : Cells {
  double step_m = 0.0;
  Vec3 origin_m;  ///< middle of the first cell
  std::vector<float> hu;
  struct MetalCell {
    std::size_t cell = 0;
    float fraction = 0.0F;
  };
  std::vector<MetalCell> metal;

  [[nodiscard]] Vec3 place_m(int i, int j, int k) const {
    return origin_m + step_m * Vec3{double(i), double(j), double(k)};
  }
};

struct BodySettings {
  double step_m = 0.0003;
  double margin_m = 0.008;  ///< around bones
  double cortex_m = 0.0012;
  std::uint64_t seed = 1;
};

/// Metal that reaches beyond the box about the bones by more than the margin is cut off, as a
/// scan's border cuts it.
[[nodiscard]] FineBody fine_body(const std::vector<BodyBone>& bones,
                                 const std::vector<MetalPiece>& metal,
                                 const BodySettings& settings);

}  // namespace orthonav::test
