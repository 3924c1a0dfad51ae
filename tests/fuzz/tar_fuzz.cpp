#include "hal/replay/image_tar.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

namespace {

/// Every member of an archive, read into images of its kind.
template <class Value>
void read_all(const InputFile& file, const replay::ImageLayout& layout) {
  auto tar = replay::ImageTar::open(file.path(), layout);
  if (!tar) {
    insist_one_line(tar.error());
    return;
  }
  const auto pixels =
      static_cast<std::size_t>(tar->width_px()) * static_cast<std::size_t>(tar->height_px());
  PlainImage<Value> image;
  for (const auto* members : {&tar->members(), &tar->brightness()}) {
    std::int64_t last = -1;
    for (const replay::ImageMember& member : *members) {
      insist(member.ticks > last);
      last = member.ticks;
      const Status read = tar->read(member, image);
      insist(read.ok() || member.png);  // a PNG is decoded when it is asked for
      if (!read) {
        insist_one_line(read.error());
      }
      insist(image.pixels.size() == pixels);
    }
  }
}

}  // namespace

/// Archives of images, as both HoloLens recorders name them.
void fuzz_tar(std::span<const std::uint8_t> input) {
  using replay::PixelKind;
  const InputFile file(input);
  read_all<std::uint8_t>(file, {});
  read_all<std::uint8_t>(file, {"vlc_lf\\"});
  read_all<std::uint16_t>(file, {"", PixelKind::kBigEndian16, 0, 0, true});
  read_all<std::uint16_t>(file, {"short_throw_depth\\", PixelKind::kLittleEndian16, 0, 0, false});
}

}  // namespace orthonav::fuzz
