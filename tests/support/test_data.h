#pragma once

#include <filesystem>
#include <string>

namespace orthonav::test {

/// A file or folder of test data, such as "anatomy/visible-human": the project's own (tests/data,
/// where each says its licence), else that of a folder shared/ beside the checkout. Where neither
/// has it, the path does not exist.
inline std::filesystem::path test_data(const std::string& name) {
  const std::filesystem::path own =
      std::filesystem::path(ORTHONAV_SOURCE_DIR) / "tests/data" / name;
  return std::filesystem::exists(own) ? own : std::filesystem::path(ORTHONAV_SHARED_DIR) / name;
}

}  // namespace orthonav::test
