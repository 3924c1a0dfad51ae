#pragma once

#include <memory>
#include <optional>
#include <string>

#include "hal/api/devices.h"
#include "hal/sim/sim_headset.h"

namespace orthonav {

struct OpenOptions {
  sim::RoomDescription room;  ///< for `sim:`; empty: a table and a pointer
  sim::SimOptions sim;
};

/// Opens a headset by URI: `sim:` (the simulated operating room; `sim:?seed=3&perfect&realtime`),
/// `replay:PATH` (a recording), `hl2ss://HOST` (a HoloLens 2 over the network;
/// `hl2ss://HOST?profile=h264`, docs/hl2ss.md). An unknown scheme or key is refused with the known
/// ones named.
Result<std::unique_ptr<Headset>> open_headset(const std::string& uri,
                                              const OpenOptions& options = {});

}  // namespace orthonav
