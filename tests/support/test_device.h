#pragma once

#include <cstdlib>
#include <string>

namespace orthonav::test {

/// Part of the name of the Vulkan device that the tests of the renderer draw on: what
/// ORTHONAV_TEST_DEVICE says, or the software rasterizer that the golden images were taken on.
inline std::string test_device() {
  const char* asked = std::getenv("ORTHONAV_TEST_DEVICE");
  return asked != nullptr ? asked : "llvmpipe";
}

}  // namespace orthonav::test
