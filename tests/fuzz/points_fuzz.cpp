#include <array>

#include "engine/case/points_file.h"
#include "tests/fuzz/input_file.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::fuzz {

/// Digitized points; the first byte chooses the format.
void fuzz_points(std::span<const std::uint8_t> input) {
  static const test::TemporaryFolder folder;
  constexpr std::array<const char*, 4> kNames = {"points.csv", "points.ply", "points.mrk.json",
                                                 "points.fcsv"};
  if (input.empty()) {
    return;
  }
  const auto points =
      engine::load_points(folder.with(kNames[input[0] % kNames.size()], text_of(input.subspan(1))));
  if (!points) {
    insist_one_line(points.error());
    return;
  }
  insist(!points->points.empty());
  insist(points->regions.empty() || points->regions.size() == points->points.size());
  for (const Vec3& point : points->points) {
    insist(point.is_finite());
  }
}

}  // namespace orthonav::fuzz
