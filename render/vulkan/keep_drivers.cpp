#include "render/vulkan/keep_drivers.h"

#if defined(__SANITIZE_ADDRESS__)

#include <dlfcn.h>
#include <link.h>

#include <string>
#include <vector>

// The validation layer of Debian 12 leaks what it allocates for pipelines and render passes; none
// of our code runs in these modules. The leak checker finds this function by its name.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libVkLayer_\nleak:libvulkan_\n";
}

namespace orthonav::render {
namespace {

int collect(dl_phdr_info* module, std::size_t, void* names) {
  const std::string name = module->dlpi_name;
  const bool of_vulkan =
      name.find("libvulkan_") != std::string::npos || name.find("libVkLayer") != std::string::npos;
  if (of_vulkan) {
    static_cast<std::vector<std::string>*>(names)->push_back(name);
  }
  return 0;
}

}  // namespace

void keep_drivers_for_leak_check() {
  std::vector<std::string> names;
  dl_iterate_phdr(collect, &names);
  for (const std::string& name : names) {
    dlopen(name.c_str(), RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
  }
}

}  // namespace orthonav::render

#else

namespace orthonav::render {

void keep_drivers_for_leak_check() {}

}  // namespace orthonav::render

#endif
