#include "tests/support/nrrd_scan.h"

#include <cstdint>
#include <fstream>
#include <vector>

#include "base/printed.h"

namespace orthonav::test {

bool write_nrrd(const std::string& path, const engine::Volume& scan) {
  std::ofstream file(path, std::ios::binary);
  const engine::VolumeGrid& grid = scan.grid;
  const Vec3 s = grid.spacing_m * 1e3;
  const Vec3 o = grid.origin_m * 1e3;
  file << printed(
      "NRRD0004\ntype: int16\ndimension: 3\nsizes: %d %d %d\nencoding: raw\nendian: little\n"
      "space: left-posterior-superior\nspace directions: (%.9f,0,0) (0,%.9f,0) (0,0,%.9f)\n"
      "space origin: (%.9f,%.9f,%.9f)\n\n",
      grid.size[0], grid.size[1], grid.size[2], s.x, s.y, s.z, o.x, o.y, o.z);
  const std::vector<std::int16_t> values(scan.values.begin(), scan.values.end());
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(2 * values.size()));
  return file.good();
}

}  // namespace orthonav::test
