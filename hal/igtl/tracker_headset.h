#pragma once

#include <memory>

#include "hal/api/devices.h"
#include "hal/igtl/tracker_options.h"

namespace orthonav::igtl {

/// Tools that another program tracks and sends over OpenIGTLink (PlusServer, 3D Slicer), as a
/// headset without cameras, display, button or voice. World and Rig are the frame that it measures
/// in, which is taken to stand still; when its connection is lost and made anew, World is another
/// one. Times are this machine's steady clock. Waits for the first pose of any of the tools; an
/// Error says what came instead.
Result<std::unique_ptr<Headset>> open_tracker(const TrackerOptions& options);

}  // namespace orthonav::igtl
