#pragma once

#include <memory>

#include "hal/api/devices.h"
#include "hal/api/headset_scheme.h"
#include "hal/igtl/tracker_options.h"

namespace orthonav::igtl {

/// Tools that another program tracks and sends over OpenIGTLink (PlusServer, 3D Slicer), as a
/// headset without cameras, display, button or voice. World and Rig are both the tracker's frame,
/// which is assumed not to move; after its connection was lost and made again, World is a new one.
/// Times are those of this machine's steady clock. Waits for the first pose of any of the tools; an
/// Error says what arrived instead.
Result<std::unique_ptr<Headset>> open_tracker(const TrackerOptions& options);

/// `igtl://HOST?TOOL=TRANSFORM&...` (`tracker_options_of`).
[[nodiscard]] HeadsetScheme scheme();

}  // namespace orthonav::igtl
