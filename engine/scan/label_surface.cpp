#include "engine/scan/label_surface.h"

#include <algorithm>
#include <array>

#include "engine/scan/label_field.h"
#include "nav/geometry/implicit_surface.h"

namespace orthonav::engine {
namespace {

constexpr double kFinestStep_m = 0.0010;
constexpr double kCoarsestStep_m = 0.0015;

/// The box around a grid, whose axes need not be those of the patient.
nav::Bounds box_of(const VolumeGrid& grid) {
  nav::Bounds box{grid.origin_m, grid.origin_m};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p =
        grid.place_m({corner & 1 ? grid.size[0] - 1.0 : 0.0, corner & 2 ? grid.size[1] - 1.0 : 0.0,
                      corner & 4 ? grid.size[2] - 1.0 : 0.0});
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], p[axis]);
      box.high[axis] = std::max(box.high[axis], p[axis]);
    }
  }
  return box;
}

SurfaceDeviation deviation_of(const LabelPart& part, const nav::TriangleMesh& mesh) {
  const nav::SurfaceIndex surface(mesh);
  std::vector<double> off_m;
  for (int k = 0; k + 1 < part.grid.size[2]; ++k) {
    for (int j = 0; j + 1 < part.grid.size[1]; ++j) {
      for (int i = 0; i + 1 < part.grid.size[0]; ++i) {
        const std::uint8_t here = part.inside[part.grid.at(i, j, k)];
        const std::array<Vec3, 3> to = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
        const std::array<std::size_t, 3> next = {
            part.grid.at(i + 1, j, k), part.grid.at(i, j + 1, k), part.grid.at(i, j, k + 1)};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (part.inside[next[axis]] != here) {
            const Vec3 index = Vec3{double(i), double(j), double(k)} + 0.5 * to[axis];
            const auto near = surface.nearest(part.grid.place_m(index));
            off_m.push_back(near ? near->distance_m : 1.0);
          }
        }
      }
    }
  }
  std::sort(off_m.begin(), off_m.end());
  const auto at = [&](double fraction) {
    return off_m[static_cast<std::size_t>(fraction * static_cast<double>(off_m.size() - 1))];
  };
  return {at(0.5), at(0.95), off_m.back()};
}

}  // namespace

Result<LabelSurface> label_surface(const LabelPart& part) {
  const LabelField field(part);
  const nav::Bounds box = box_of(part.grid);
  const double step_m = std::clamp(part.grid.least_spacing_m(), kFinestStep_m, kCoarsestStep_m);
  auto mesh =
      nav::checked_bone(nav::main_part(nav::surface_of([&](Vec3 p) { return field.value_m(p); },
                                                       box.low, box.high, step_m))
                            .mesh);
  if (!mesh) {
    return mesh.error();
  }
  const SurfaceDeviation deviation = deviation_of(part, *mesh);
  return LabelSurface{std::move(*mesh), deviation};
}

}  // namespace orthonav::engine
