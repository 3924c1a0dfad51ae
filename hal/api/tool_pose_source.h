#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/tracked.h"
#include "base/transform.h"
#include "hal/api/frame_order.h"

namespace orthonav {

/// Where a device's tools were at one moment. The buffer is reused from call to call.
struct ToolPoses : FrameHeader {
  /// In the order of their names: measured at `time`, with the covariance that the device or its
  /// configuration states; or lost.
  std::vector<Tracked<Transform<World, Marker>>> tools;

  /// Empties it and keeps the buffer.
  void clear();
};

/// Pull interface of a device that measures tools itself, such as an optical tracker. Contract,
/// kept by the public call for every device: that of StereoCamera on order, and every tool that the
/// device names is in every answer, either measured or lost, never predicted. Poses that break it
/// result in an Error and are not passed on (`poses` comes back empty).
class ToolPoseSource {
 public:
  virtual ~ToolPoseSource() = default;
  /// Of the tools that it measures, at least one; the same at every call.
  [[nodiscard]] std::span<const std::string> names() const { return do_names(); }
  /// Fills `poses` with the next ones, never the same twice. Does not block.
  Result<Next> next(ToolPoses& poses);

 private:
  [[nodiscard]] virtual std::span<const std::string> do_names() const = 0;
  virtual Result<Next> do_next(ToolPoses& poses) = 0;

  FrameOrder order_;
};

}  // namespace orthonav
