#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/api/headset_scheme.h"
#include "hal/sim/sim_headset.h"

namespace orthonav {

struct OpenOptions {
  sim::RoomDescription room;  ///< for `sim:`; empty: a table and a pointer
  sim::SimOptions sim;
  /// What a headset's own speech recognition listens for, lower case; none: it hears nothing.
  std::vector<std::string> phrases;
};

/// The opened headset with its room.
struct OpenedHeadset : OpenedDevice {
  /// The room that its cameras see, if simulated; null otherwise. Exists as long as the headset.
  /// Gives access to the ground truth, which a headset does not reveal.
  sim::SimHeadset* room = nullptr;
  /// Path of the cameras' calibration that a rig file names; empty: none.
  std::string calibration_file;
};

/// Opens a headset by URI: `sim:` (the simulated operating room;
/// `sim:?seed=3&perfect&realtime&depth`), `replay:PATH` (a recording; `replay:PATH?pace=fast`,
/// `realtime` or `step`; `?stamps=exact`), `hl2ss://HOST` (a HoloLens 2 over the network;
/// `hl2ss://HOST?profile=h264`, docs/hl2ss.md), `igtl://HOST` (tools that another program tracks,
/// docs/igtl.md), `openxr:+URI` (an OpenXR headset that takes the cameras of another one). An
/// unknown scheme or key is refused with the known ones named.
Result<std::unique_ptr<Headset>> open_headset(const std::string& uri,
                                              const OpenOptions& options = {});

/// Refuses a URI that can't be opened judging by its text alone (scheme, keys, values), without
/// touching any device; the part after `openxr:` is only parsed when it is opened.
Status check_headset_uri(const std::string& uri);

/// Of a device that lives outside of this library: all functions above know its scheme from now on.
/// Refuses a name that is taken or malformed, and a scheme without `open`. Thread-safe.
Status register_scheme(HeadsetScheme scheme);

/// The same as `open_headset`, with the simulated room.
Result<OpenedHeadset> open_with_room(const std::string& uri, const OpenOptions& options = {});

}  // namespace orthonav
