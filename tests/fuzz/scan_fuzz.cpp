#include <algorithm>
#include <array>

#include "engine/scan/volume_file.h"
#include "engine/scan/volume_reader.h"
#include "tests/fuzz/input_file.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::fuzz {
namespace {

constexpr std::array<const char*, 4> kNames = {"scan.nrrd", "scan.nii", "scan.nii.gz", "dicom"};

/// Two slices of DICOM in a folder of their own: two bytes say how long the first one is.
std::string folder_with_slices(const test::TemporaryFolder& folder,
                               std::span<const std::uint8_t> input) {
  std::filesystem::create_directories(folder / kNames.back());
  const std::size_t length = std::size_t{input[0]} + 256 * std::size_t{input[1]};
  const auto slices = input.subspan(2);
  const auto first = slices.first(std::min(length, slices.size()));
  std::ignore = folder.with("dicom/1", text_of(first));
  std::ignore = folder.with("dicom/2", text_of(slices.subspan(first.size())));
  return folder.file(kNames.back());
}

}  // namespace

/// Scans; the first byte chooses the format.
void fuzz_scan(std::span<const std::uint8_t> input) {
  static const test::TemporaryFolder folder;
  if (input.size() < 3) {
    return;
  }
  // GDCM ends its program where an assertion of its own fails; the others run here, where the
  // fuzzer sees what they reach.
  const std::size_t format = input[0] % kNames.size();
  const auto content = input.subspan(1);
  const auto volume = format + 1 == kNames.size()
                          ? engine::load_volume(folder_with_slices(folder, content))
                          : engine::read_volume(folder.with(kNames[format], text_of(content)), {});
  if (!volume) {
    insist_one_line(volume.error());
    return;
  }
  insist(engine::check_grid(volume->grid).ok());
  insist(volume->values.size() == volume->grid.voxels() * volume->layers);
}

}  // namespace orthonav::fuzz
