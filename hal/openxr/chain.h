#pragma once

#include <cstdint>
#include <vector>

#include "base/result.h"
#include "hal/openxr/xr.h"

namespace orthonav::openxr {

/// One swapchain, of which one image at a time belongs to the application: from `acquire` to
/// `release`. Destroyed by hand, since a session that is lost takes it along.
class Chain {
 public:
  /// What all swapchains here have in common: one level, one face, one sample.
  [[nodiscard]] static XrSwapchainCreateInfo plain(std::int64_t format, int width_px,
                                                   int height_px);
  /// Writes the images' handles into `images`.
  Status create(XrSession session, const XrSwapchainCreateInfo& info,
                std::vector<std::uint64_t>& images);
  void destroy();

  /// XR_TIMEOUT_EXPIRED when the image is not free in time: the next call waits on for the same
  /// one. An image that is there already is kept.
  XrResult acquire(XrDuration patience);
  /// Nothing to do where no image was waited for.
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
