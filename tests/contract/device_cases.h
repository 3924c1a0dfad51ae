#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "hal/api/devices.h"

namespace orthonav::test {

/// One implementation of the device interfaces; every `open` gives the same device from its start.
/// Its sessions are a few seconds long at most.
struct DeviceCase {
  std::string name;
  std::function<std::unique_ptr<Headset>()> open;
  bool has_events = true;  ///< clicker and voice deliver events
  bool has_images = true;  ///< false: they stay black, as nothing uses them
  /// How far past the newest pair the head may already have been measured.
  Duration head_ahead{};
  std::size_t depth_cameras = 0;
  bool measures_tools = false;  ///< itself, and has no cameras
};
inline void PrintTo(const DeviceCase& device, std::ostream* out) { *out << device.name; }

/// All implementations.
std::vector<DeviceCase> device_cases();

}  // namespace orthonav::test
