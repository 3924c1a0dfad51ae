#include <dlfcn.h>
#include <link.h>
#include <vulkan/vulkan.h>

#include <string>
#include <vector>

// Stands in front of the Vulkan loader's function in every program of tests. The loader unmaps
// drivers and layers with the last instance; here all that is loaded then stays until the program
// ends. NVIDIA's driver needs static thread-local storage, which the C library does not give back:
// after some 65 instances, which only tests make, it could not be loaded any more. And leaks of a
// layer that is unmapped would be reported without a name that could be suppressed (lsan.supp).

namespace {

int collect(dl_phdr_info* module, std::size_t, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(module->dlpi_name);
  return 0;
}

}  // namespace

extern "C" VKAPI_ATTR void VKAPI_CALL vkDestroyInstance(VkInstance instance,
                                                        const VkAllocationCallbacks* allocator) {
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
  const auto destroy =
      reinterpret_cast<PFN_vkDestroyInstance>(dlsym(RTLD_NEXT, "vkDestroyInstance"));
  destroy(instance, allocator);
}
