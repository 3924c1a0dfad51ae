#include "hal/openxr/view_setup.h"

#include <algorithm>
#include <array>

#include "hal/openxr/xr_error.h"

namespace orthonav::openxr {
namespace {

// XR_EXT_local_floor, which is newer than the loader's headers.
constexpr auto kLocalFloor = static_cast<XrReferenceSpaceType>(1000426000);

Result<std::vector<XrViewConfigurationView>> views_of(const Runtime& runtime) {
  std::vector<XrViewConfigurationView> views(2, {XR_TYPE_VIEW_CONFIGURATION_VIEW});
  std::uint32_t count = 0;
  const XrResult told = xrEnumerateViewConfigurationViews(runtime.instance(), runtime.system(),
                                                          kStereo, 2, &count, views.data());
  if (XR_FAILED(told)) {
    return error_of("ask for the images of two eyes", told);
  }
  if (count != 2) {
    return Error{"openxr: the headset has " + std::to_string(count) + " views, must be 2"};
  }
  return views;
}

Result<std::vector<XrEnvironmentBlendMode>> blends_of(const Runtime& runtime) {
  std::uint32_t count = 0;
  XrResult told = xrEnumerateEnvironmentBlendModes(runtime.instance(), runtime.system(), kStereo, 0,
                                                   &count, nullptr);
  std::vector<XrEnvironmentBlendMode> modes(count);
  if (XR_SUCCEEDED(told)) {
    told = xrEnumerateEnvironmentBlendModes(runtime.instance(), runtime.system(), kStereo, count,
                                            &count, modes.data());
  }
  if (XR_FAILED(told)) {
    return error_of("ask how it meets the world", told);
  }
  return modes;
}

}  // namespace

std::optional<XrEnvironmentBlendMode> best_blend(std::span<const XrEnvironmentBlendMode> offered) {
  for (const XrEnvironmentBlendMode mode :
       {XR_ENVIRONMENT_BLEND_MODE_ADDITIVE, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND,
        XR_ENVIRONMENT_BLEND_MODE_OPAQUE}) {
    if (std::find(offered.begin(), offered.end(), mode) != offered.end()) {
      return mode;
    }
  }
  return std::nullopt;
}

WorldBlend blend_of(XrEnvironmentBlendMode mode) {
  if (mode == XR_ENVIRONMENT_BLEND_MODE_ADDITIVE) {
    return WorldBlend::kAdditive;
  }
  return mode == XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND ? WorldBlend::kAlpha : WorldBlend::kOpaque;
}

ViewSetup sized(std::span<const XrViewConfigurationView> views) {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  for (const XrViewConfigurationView& view : views) {
    width = std::max(width, view.recommendedImageRectWidth);
    height = std::max(height, view.recommendedImageRectHeight);
  }
  for (const XrViewConfigurationView& view : views) {
    width = std::min(width, view.maxImageRectWidth);
    height = std::min(height, view.maxImageRectHeight);
  }
  ViewSetup setup;
  setup.width_px = static_cast<int>(width);
  setup.height_px = static_cast<int>(height);
  return setup;
}

XrReferenceSpaceType best_space(std::span<const XrReferenceSpaceType> offered) {
  for (const XrReferenceSpaceType type : {XR_REFERENCE_SPACE_TYPE_STAGE, kLocalFloor}) {
    if (std::find(offered.begin(), offered.end(), type) != offered.end()) {
      return type;
    }
  }
  return XR_REFERENCE_SPACE_TYPE_LOCAL;  // every runtime has it
}

Result<ViewSetup> view_setup_of(const Runtime& runtime, const HeadsetTraits& traits) {
  const auto views = views_of(runtime);
  if (!views) {
    return views.error();
  }
  const auto blends = blends_of(runtime);
  if (!blends) {
    return blends.error();
  }
  const auto blend = best_blend(*blends);
  if (!blend) {
    return Error{"openxr: the headset offers no known way to meet the world"};
  }
  ViewSetup setup = sized(*views);
  setup.blend = *blend;
  setup.most_layers = traits.most_layers;
  setup.most_px = traits.most_px;
  return setup;
}

}  // namespace orthonav::openxr
