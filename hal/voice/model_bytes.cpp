#include "hal/voice/model_bytes.h"

#include <fstream>
#include <iterator>

namespace orthonav::voice {

namespace {

constexpr std::uint32_t kByteOrder = 0x11223344;
constexpr std::string_view kHeaderEnd = "endhdr\n";
constexpr std::size_t kLongestHeader = 4096;

}  // namespace

std::string model_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string sphinx_file_start() {
  std::string start = "s3\nversion 1.0\n" + std::string(kHeaderEnd);
  put(start, kByteOrder);
  return start;
}

std::optional<std::string_view> after_sphinx_file_start(std::string_view file) {
  const std::size_t header = file.find(kHeaderEnd);
  if (header == std::string_view::npos || header > kLongestHeader) {
    return std::nullopt;
  }
  file.remove_prefix(header + kHeaderEnd.size());
  if (take<std::uint32_t>(file) != kByteOrder) {
    return std::nullopt;
  }
  return file;
}

Error made_for_another_model() {
  return Error{"voice: the acoustic model is not the one that the adaptation was made for"};
}

}  // namespace orthonav::voice
