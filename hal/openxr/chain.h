#pragma once

#include <cstdint>
#include <vector>

#include "base/result.h"
#include "hal/openxr/xr.h"

namespace orthonav::openxr {

/// One swapchain. Between `acquire` and `release` one of its images belongs to the application.
/// Must be destroyed explicitly, since losing the session destroys it too.
class Chain {
 public:
  /// A swapchain of 2D images with one level and one sample, which can be sampled besides `usage`.
  [[nodiscard]] static XrSwapchainCreateInfo plain(XrSwapchainUsageFlags usage, std::int64_t format,
                                                   int width_px, int height_px);
  /// Writes the images' handles into `images`.
  Status create(XrSession session, const XrSwapchainCreateInfo& info,
                std::vector<std::uint64_t>& images);
  void destroy();

  /// XR_TIMEOUT_EXPIRED if the image is not free in time: the next call waits for the same one.
  /// Does nothing if an image is held already.
  XrResult acquire(XrDuration patience);
  /// Does nothing unless an image was waited for.
  XrResult release();
  /// Whether an image may be drawn into.
  [[nodiscard]] bool ready() const { return waited_; }
  [[nodiscard]] std::uint32_t index() const { return index_; }
  [[nodiscard]] XrSwapchain handle() const { return handle_; }

 private:
  XrSwapchain handle_ = XR_NULL_HANDLE;
  std::uint32_t index_ = 0;
  bool acquired_ = false;
  bool waited_ = false;
};

}  // namespace orthonav::openxr
