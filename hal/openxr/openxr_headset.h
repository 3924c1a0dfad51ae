#pragma once

#include <memory>
#include <string>

#include "hal/api/forwarding_headset.h"
#include "hal/openxr/rig.h"

namespace orthonav::openxr {

/// Any headset with OpenXR and Vulkan, with the cameras of another one: `cameras` gives pairs,
/// clock, voice, and its clicker beside the runtime's select button. Pixels go to the runtime.
///
/// Mounted cameras get their poses from the runtime; what tracks them otherwise is not asked. Those
/// elsewhere keep their own world, and the display is laid into it. The map's epoch rises when the
/// runtime's space moves and with each new session.
class OpenxrHeadset : public ForwardingHeadset {
 public:
  /// Connects with nothing yet: that is `pixels().open()`.
  static std::unique_ptr<OpenxrHeadset> around(std::unique_ptr<Headset> cameras,
                                               const RigOnHead& rig);

 protected:
  explicit OpenxrHeadset(Headset& cameras) : ForwardingHeadset(cameras) {}
};

/// The runtime of this machine in words, such as "Monado(XRT) 21.0.0, Simulated HMD"; an Error says
/// in one line what is missing and how to get it.
[[nodiscard]] Result<std::string> describe_runtime();

}  // namespace orthonav::openxr
