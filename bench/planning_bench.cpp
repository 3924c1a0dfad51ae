// How long screws are planned for a vertebra from its surface alone: median and slowest over the
// real vertebrae that are at hand and the built-in spine. The surface's index is not counted.
#include <cstdio>
#include <vector>

#include "base/stopwatch.h"
#include "bench/quantile.h"
#include "engine/case/screw_sizes.h"
#include "engine/phantom/phantom.h"
#include "nav/planning/pedicle_screws.h"
#include "tests/support/anatomy.h"

namespace orthonav {
namespace {

int run() {
  std::vector<nav::TriangleMesh> bones;
  for (test::AnatomyLevel& level : test::anatomy_levels()) {
    bones.push_back(std::move(level.mesh));
  }
  for (engine::CaseLevel& level : engine::phantom().levels) {
    bones.push_back(std::move(level.mesh));
  }
  const std::vector<nav::ImplantSize> sizes = engine::ScrewSizes::built_in().implants();
  std::vector<double> times_s;
  for (const nav::TriangleMesh& bone : bones) {
    const nav::SurfaceIndex surface(bone);
    const Stopwatch watch;
    if (!nav::plan_pedicle_screws(bone, surface, sizes)) {
      std::fprintf(stderr, "a vertebra was refused\n");
      return 1;
    }
    times_s.push_back(watch.elapsed_ms() * 1e-3);
  }
  std::printf("%zu vertebrae: median %.2f s, slowest %.2f s\n", times_s.size(),
              quantile(times_s, 0.5), quantile(times_s, 1.0));
  return 0;
}

}  // namespace
}  // namespace orthonav

int main() { return orthonav::run(); }
