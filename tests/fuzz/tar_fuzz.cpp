#include "hal/replay/image_tar.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Archives of images, as both HoloLens recorders name them.
void fuzz_tar(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  for (const char* prefix : {"", "vlc_lf\\"}) {
    auto tar = replay::ImageTar::open(file.path(), replay::ImageLayout{prefix});
    if (!tar) {
      insist(tar.error().message.find('\n') == std::string::npos);
      continue;
    }
    GreyImage image;
    std::int64_t last = -1;
    for (const replay::ImageMember& member : tar->members()) {
      insist(member.ticks > last);
      last = member.ticks;
      insist(tar->read(member, image).ok());
      insist(image.pixels.size() == std::size_t{640} * 480);
    }
  }
}

}  // namespace orthonav::fuzz
