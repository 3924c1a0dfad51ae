#pragma once

#include <memory>
#include <string>

#include "hal/api/forwarding_headset.h"
#include "hal/openxr/rig.h"

namespace orthonav::openxr {

/// Any headset with OpenXR and Vulkan, with the cameras of another one: pairs, clock and voice come
/// from `cameras`, clicks from its clicker and the runtime's select button. Pixels go to the
/// runtime.
///
/// Mounted cameras get their poses from the runtime; their own tracking is not used. Cameras
/// elsewhere keep their own world, and the display is placed in it. The map's epoch rises when the
/// runtime's space moves and with each new session.
class OpenxrHeadset : public ForwardingHeadset {
 public:
  /// Does not connect yet; `pixels().open()` does.
  static std::unique_ptr<OpenxrHeadset> around(std::unique_ptr<Headset> cameras,
                                               const RigOnHead& rig);

 protected:
  explicit OpenxrHeadset(Headset& cameras) : ForwardingHeadset(cameras) {}
};

/// Names the runtime of this machine, such as "Monado(XRT) 21.0.0, Simulated HMD". An Error says in
/// one line what is missing and how to get it.
[[nodiscard]] Result<std::string> describe_runtime();

}  // namespace orthonav::openxr
