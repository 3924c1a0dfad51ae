#pragma once

#include <vector>

#include "hal/api/pixel_display.h"
#include "hal/openxr/chain.h"
#include "hal/openxr/view_setup.h"

namespace orthonav::openxr {

/// The images of both eyes: one swapchain of two layers, or one swapchain per eye. Between
/// `acquire` and `release` one image of each chain belongs to the application.
class Swapchains {
 public:
  Swapchains() = default;
  ~Swapchains() { destroy(); }
  Swapchains(const Swapchains&) = delete;
  Swapchains& operator=(const Swapchains&) = delete;

  /// Uses the format that suits the renderer best; an Error if none does. With depth if wanted and
  /// if the renderer can draw into an offered depth format.
  Status create(XrSession session, const ViewSetup& setup, const FormatPreference& preference,
                bool depth);
  void destroy();
  [[nodiscard]] const EyeImages& images() const { return images_; }

  /// XR_TIMEOUT_EXPIRED if an image is not free in time: this frame is submitted without pixels,
  /// and the next one may try again.
  XrResult acquire(std::vector<std::uint32_t>& indices);
  /// Releases every image that was acquired and waited for.
  XrResult release();
  /// The part of the images that shows an eye's view.
  [[nodiscard]] XrSwapchainSubImage part_of(std::size_t eye) const { return part(0, eye); }
  [[nodiscard]] bool has_depth() const { return !images_.depth_chains.empty(); }
  [[nodiscard]] XrSwapchainSubImage depth_of(std::size_t eye) const {
    return part(images_.chains.size(), eye);
  }

 private:
  enum class Content { kColour, kDepth };
  Status add_chains(XrSession session, Content content);
  Status add_chain(XrSession session, Content content);
  [[nodiscard]] XrSwapchainSubImage part(std::size_t first_chain, std::size_t eye) const;

  std::vector<Chain> chains_;  ///< colour, then depth
  EyeImages images_;
};

}  // namespace orthonav::openxr
