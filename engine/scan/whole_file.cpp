#include "engine/scan/whole_file.h"

#include <zlib.h>

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

}  // namespace orthonav::engine
