#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <link.h>

#include <string>
#include <vector>

#include "render/renderer.h"

namespace orthonav::render::keep_drivers_test {
namespace {

int collect_drivers(dl_phdr_info* module, std::size_t, void* names) {
  const std::string name = module->dlpi_name;
  if (name.find("libvulkan_") != std::string::npos ||
      name.find("libGLX_nvidia") != std::string::npos) {
    static_cast<std::vector<std::string>*>(names)->push_back(name);
  }
  return 0;
}

/// Of tests/support/keep_drivers.cpp.
TEST(KeepDrivers, StayLoadedAfterTheLastInstance) {
  ASSERT_FALSE(list_devices().empty());
  std::vector<std::string> drivers;
  dl_iterate_phdr(collect_drivers, &drivers);
  EXPECT_THAT(drivers, ::testing::Not(::testing::IsEmpty()));
}

}  // namespace
}  // namespace orthonav::render::keep_drivers_test
