#include "engine/io/grey_image_file.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Pictures by their content: PGM, PNG and JPEG.
void fuzz_pgm(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  const auto image = engine::load_grey(file.path());
  if (image) {
    insist(image->pixels.size() ==
           static_cast<std::size_t>(image->width_px) * static_cast<std::size_t>(image->height_px));
  }
}

}  // namespace orthonav::fuzz
