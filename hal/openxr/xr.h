#pragma once

// OpenXR's headers, for the files of this folder. They mention Vulkan; here its handles are opaque
// names that are only passed on, and its headers stay in render/.

#include <ctime>

struct VkInstance_T;
struct VkPhysicalDevice_T;
struct VkDevice_T;
struct VkImage_T;
struct VkInstanceCreateInfo;
struct VkDeviceCreateInfo;
struct VkAllocationCallbacks;
using VkInstance = VkInstance_T*;
using VkPhysicalDevice = VkPhysicalDevice_T*;
using VkDevice = VkDevice_T*;
using VkImage = VkImage_T*;
static_assert(sizeof(void*) == 8, "where pointers are shorter, VkImage is a number");
using PFN_vkGetInstanceProcAddr = void (*)();
// Flags, which headers newer than those of Debian 12 mention.
using VkImageCreateFlags = unsigned;
using VkImageUsageFlags = unsigned;
// Enumerations, which are ints in C.
using VkResult = int;
using VkFormat = int;
using VkFilter = int;
using VkSamplerMipmapMode = int;
using VkSamplerAddressMode = int;
using VkComponentSwizzle = int;

#define XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_TIMESPEC
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
