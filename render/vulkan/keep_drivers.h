#pragma once

namespace orthonav::render {

/// Under AddressSanitizer: keeps the Vulkan drivers and layers that are loaded now in memory until
/// the program ends. The loader unmaps them with the last instance, and with them their globals, so
/// memory that a driver keeps for its lifetime would be reported as leaked at exit. Otherwise does
/// nothing.
void keep_drivers_for_leak_check();

}  // namespace orthonav::render
