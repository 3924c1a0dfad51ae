#pragma once

namespace orthonav::render {

/// Keeps every library that is loaded now in memory until the program ends; called once the Vulkan
/// loader has opened its drivers and layers. The loader unmaps them with the last instance.
/// NVIDIA's driver needs static thread-local storage, which the C library does not give back: after
/// some 65 instances it could not be loaded any more. And what a driver keeps for its lifetime
/// would be reported as leaked once its globals are gone.
void keep_loaded_drivers();

}  // namespace orthonav::render
