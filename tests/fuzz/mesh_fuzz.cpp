#include <array>

#include "engine/io/mesh_file.h"
#include "tests/fuzz/input_file.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::fuzz {

/// Meshes; the first byte chooses the format.
void fuzz_mesh(std::span<const std::uint8_t> input) {
  static const test::TemporaryFolder folder;
  constexpr std::array<const char*, 3> kNames = {"mesh.stl", "mesh.ply", "mesh.obj"};
  if (input.empty()) {
    return;
  }
  const std::string path = folder.with(kNames[input[0] % kNames.size()], text_of(input.subspan(1)));
  const auto mesh = engine::load_mesh(path, 1e-3);
  if (!mesh) {
    insist_one_line(mesh.error());
    return;
  }
  insist(!mesh->triangles.empty());
  for (const auto& triangle : mesh->triangles) {
    for (const std::uint32_t corner : triangle) {
      insist(corner < mesh->vertices_m.size() && mesh->vertices_m[corner].is_finite());
    }
  }
}

}  // namespace orthonav::fuzz
