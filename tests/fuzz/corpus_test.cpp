#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "fuzzers.h"

namespace orthonav::fuzz {
namespace {

std::vector<std::filesystem::path> corpus_of(std::string_view name) {
  const auto folder = std::filesystem::path(ORTHONAV_SOURCE_DIR) / "tests/fuzz/corpus" / name;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Corpus : public ::testing::TestWithParam<Fuzzer> {};

/// Inputs that once broke a reader, or that lead far into it, must always pass.
TEST_P(Corpus, PassesThrough) {
  const auto files = corpus_of(GetParam().name);
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename());
    GetParam().run(bytes_of(file));
  }
}

/// Cut off anywhere, and each byte wrong once: the cheap half of what a fuzzer tries.
TEST_P(Corpus, PassesThroughDamaged) {
  // A child process reads HDF5, a new one each time.
  const bool in_child = std::string_view(GetParam().name) == "transform";
  const std::size_t most_cuts = in_child ? 80 : 400;
  for (const auto& file : corpus_of(GetParam().name)) {
    SCOPED_TRACE(file.filename());
    std::vector<std::uint8_t> bytes = bytes_of(file);
    const std::size_t step = 1 + bytes.size() / most_cuts;
    for (std::size_t at = 0; at < bytes.size(); at += step) {
      GetParam().run(std::span(bytes).first(at));
      bytes[at] ^= 0xffu;
      GetParam().run(bytes);
      bytes[at] ^= 0xffu;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Corpus, ::testing::ValuesIn(kFuzzers),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace orthonav::fuzz
