#pragma once

#include <optional>
#include <span>

#include "hal/api/pixel_display.h"
#include "hal/openxr/runtime.h"

namespace orthonav::openxr {

inline constexpr XrViewConfigurationType kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

/// How the headset displays pixels, as known before there is a session.
struct ViewSetup {
  XrEnvironmentBlendMode blend = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  int width_px = 0;  ///< of each eye's image
  int height_px = 0;
  std::uint32_t most_layers = 1;
  std::array<int, 2> most_px{};  ///< of any image
};

/// An Error when the headset does not have two eyes.
[[nodiscard]] Result<ViewSetup> view_setup_of(const Runtime& runtime, const HeadsetTraits& traits);

/// Prefers additive, then alpha, then opaque: the more of the world the surgeon sees, the better.
/// Nothing if none of the three is offered.
[[nodiscard]] std::optional<XrEnvironmentBlendMode> best_blend(
    std::span<const XrEnvironmentBlendMode> offered);
[[nodiscard]] WorldBlend blend_of(XrEnvironmentBlendMode mode);
/// The larger of the two eyes' recommended sizes, within what both allow.
[[nodiscard]] ViewSetup sized(std::span<const XrViewConfigurationView> views);
/// Prefers STAGE, then LOCAL_FLOOR, then LOCAL: recentring by the wearer does not move STAGE.
[[nodiscard]] XrReferenceSpaceType best_space(std::span<const XrReferenceSpaceType> offered);

}  // namespace orthonav::openxr
