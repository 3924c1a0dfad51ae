#include "engine/scan/whole_file.h"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

#include "base/file_code.h"

namespace orthonav::engine {

Status check_whole(const std::string& path, std::uint64_t least_bytes) {
  constexpr unsigned kAtOnce = 1u << 20u;
  const gzFile file = ::gzopen(path.c_str(), "rb");
  if (file == nullptr) {
    return Error{"can't be opened", code_of_unopened(path)};
  }
  std::vector<char> room(kAtOnce);
  std::uint64_t bytes = 0;
  int count = 0;
  while ((count = ::gzread(file, room.data(), kAtOnce)) > 0) {
    bytes += static_cast<std::uint64_t>(count);
  }
  int code = Z_OK;
  ::gzerror(file, &code);
  ::gzclose(file);
  if (count < 0 || code != Z_OK) {
    return Error{"is cut off or damaged after " + std::to_string(bytes) + " bytes"};
  }
  if (bytes < least_bytes) {
    return Error{"is cut off: it holds " + std::to_string(bytes) + " bytes, must hold " +
                 std::to_string(least_bytes)};
  }
  return {};
}

Status check_long_enough(const std::string& path, std::uint64_t bytes) {
  // What deflate reaches at best (zlib's technical details); lossless JPEG stays far below.
  constexpr std::uint64_t kBestCompression = 1032;
  std::error_code code;
  const std::uintmax_t length = std::filesystem::file_size(path, code);
  if (code) {
    return Error{"can't be read: " + code.message()};
  }
  if (bytes / kBestCompression > length) {
    return Error{"is cut off or damaged: it is " + std::to_string(length) +
                 " bytes long, too short for " + std::to_string(bytes) + " bytes of voxels"};
  }
  return {};
}

Status check_names_no_other_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  // An empty line ends the header.
  for (std::string line; std::getline(file, line) && !line.empty() && line != "\r";) {
    std::transform(line.begin(), line.end(), line.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (line.starts_with("data file:") || line.starts_with("datafile:")) {
      return Error{"its voxels are in another file; save the scan as one file"};
    }
  }
  return {};
}

}  // namespace orthonav::engine
