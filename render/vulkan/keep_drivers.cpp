#include "render/vulkan/keep_drivers.h"

#include <dlfcn.h>
#include <link.h>

#include <string>
#include <vector>

#if defined(__SANITIZE_ADDRESS__)
// The validation layer of Debian 12 leaks what it allocates for pipelines and render passes; none
// of our code runs in these modules. The leak checker finds this function by its name.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libVkLayer_\nleak:libvulkan_\n";
}
#endif

namespace orthonav::render {
namespace {

int collect(dl_phdr_info* module, std::size_t, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(module->dlpi_name);
  return 0;
}

}  // namespace

void keep_loaded_drivers() {
  std::vector<std::string> names;
  dl_iterate_phdr(collect, &names);
  for (const std::string& name : names) {
    // The program itself has no name, and stays anyway.
    void* const library =
        name.empty() ? nullptr : dlopen(name.c_str(), RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
    if (library != nullptr) {
      dlclose(library);
    }
  }
}

}  // namespace orthonav::render
