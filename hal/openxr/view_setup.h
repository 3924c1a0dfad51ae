#pragma once

#include <optional>
#include <span>

#include "hal/api/pixel_display.h"
#include "hal/openxr/runtime.h"

namespace orthonav::openxr {

inline constexpr XrViewConfigurationType kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

/// How the headset shows pixels: what is enumerated of it before there is a session.
struct ViewSetup {
  XrEnvironmentBlendMode blend = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  int width_px = 0;  ///< of each eye's image
  int height_px = 0;
};

/// One line when the headset has no two eyes.
[[nodiscard]] Result<ViewSetup> view_setup_of(const Runtime& runtime);

/// Additive before alpha before opaque: the more of the world the surgeon sees, the better. Nothing
/// when none of the three is offered.
[[nodiscard]] std::optional<XrEnvironmentBlendMode> best_blend(
    std::span<const XrEnvironmentBlendMode> offered);
[[nodiscard]] WorldBlend blend_of(XrEnvironmentBlendMode mode);
/// The larger of what both eyes recommend, within what both allow.
[[nodiscard]] ViewSetup sized(std::span<const XrViewConfigurationView> views);
/// STAGE before LOCAL_FLOOR before LOCAL: what a wearer's recentring leaves alone comes first.
[[nodiscard]] XrReferenceSpaceType best_space(std::span<const XrReferenceSpaceType> offered);

}  // namespace orthonav::openxr
