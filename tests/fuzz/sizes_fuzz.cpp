#include "engine/case/screw_sizes_file.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Lists of screw sizes: an accepted list has no problem, and a size for each of its screws.
void fuzz_sizes(std::span<const std::uint8_t> input) {
  const auto sizes = engine::load_screw_sizes(InputFile(input).path());
  if (!sizes) {
    insist_one_line(sizes.error());
    return;
  }
  insist(sizes->check().empty());
  for (const nav::ImplantSize& implant : sizes->implants()) {
    insist(sizes->has(implant.diameter_m, implant.length_m));
  }
}

}  // namespace orthonav::fuzz
