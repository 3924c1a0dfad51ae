#include "engine/scan/volume_file.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include "engine/scan/child_process.h"
#include "engine/scan/dicom_folder.h"
#include "engine/scan/volume_bytes.h"
#include "engine/scan/volume_reader.h"

namespace orthonav::engine {
namespace {

namespace fs = std::filesystem;

/// Many times what any whole scan needs. A series of slices is bounded by its length: GDCM takes
/// as much memory as a damaged length says.
ChildLimits limits_for(const std::string& path) {
  constexpr std::uintmax_t kBytesASecond = 1'000'000;
  constexpr std::uint64_t kBestCompression = 64;
  constexpr std::uint64_t kGibibyte = std::uint64_t{1} << 30;
  // 2^30 voxels of eight bytes, and as floats.
  constexpr std::uint64_t kLargestFile = 13 * kGibibyte;
  std::error_code code;
  if (!fs::is_directory(path, code)) {
    const std::uintmax_t bytes = fs::is_regular_file(path, code) ? fs::file_size(path, code) : 0;
    return {std::chrono::seconds(10 + bytes / kBytesASecond), kLargestFile};
  }
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(path, code)) {
    const std::uintmax_t size = entry.is_regular_file(code) ? entry.file_size(code) : 0;
    bytes += code ? 0 : size;
  }
  return {std::chrono::seconds(10 + bytes / kBytesASecond), kGibibyte + kBestCompression * bytes};
}

}  // namespace

Result<Volume> load_volume(const std::string& path, const std::string& series) {
  const auto bytes = bytes_from_child(
      limits_for(path), [&](int file) { return write_volume(file, read_volume(path, series)); });
  if (!bytes) {
    return Error{path + ": " + bytes.error().message, bytes.error().code};
  }
  return volume_of(bytes->view());
}

Result<std::vector<SeriesSummary>> list_series(const std::string& path) {
  std::error_code code;
  if (!fs::exists(path, code)) {
    return Error{path + ": no such file or folder", ErrorCode::kNotFound};
  }
  const auto bytes = bytes_from_child(limits_for(path), [&](int file) {
    return write_series(file, summaries_of(dicom_slices(path)));
  });
  if (!bytes) {
    return Error{path + ": " + bytes.error().message, bytes.error().code};
  }
  auto series = series_of(bytes->view());
  if (series.empty()) {
    return Error{path + ": no DICOM slices"};
  }
  return series;
}

}  // namespace orthonav::engine
