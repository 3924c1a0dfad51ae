#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "base/image.h"
#include "base/result.h"
#include "base/time.h"
#include "base/tracked.h"
#include "base/transform.h"

namespace orthonav {

enum class Next {
  kFrame,  ///< the frame was filled
  kNone,   ///< nothing new yet; ask again later
  kEnd     ///< the stream has ended for good
};

/// A time as written in messages.
[[nodiscard]] std::string in_seconds(Timestamp t);

/// What every frame of a device says, whatever it holds.
struct FrameHeader {
  std::int64_t sequence = 0;
  /// The map that World belongs to. It increases when the device's map has moved or was replaced
  /// (recentred, relocalised, lost and found again): earlier positions in World then mean nothing.
  std::int64_t map_epoch = 0;
  Timestamp time{};  ///< mid-exposure
  /// Where the headset was at `time`; absent while the headset is not located.
  std::optional<Transform<World, Rig>> world_from_rig;
};

/// Whether a device may publish a pose: finite, and a rotation up to rounding.
[[nodiscard]] bool is_rigid(const Transform<World, Rig>& pose);
/// Whether a device may state this error of a pose: finite, without a negative variance.
[[nodiscard]] bool is_sound(const PoseCovariance& covariance);

/// The contract of every stream of frames, from any device: times and sequence numbers strictly
/// increase, the map's epoch never decreases, a pose is a rigid motion; after kEnd there is only
/// kEnd. A `Frame` is a FrameHeader with clear().
class FrameOrder {
 public:
  /// A device's public call: `do_next` does the work, `check_content` says whether what the
  /// frame holds is as the device describes it. A frame that breaks the contract comes back empty,
  /// with an Error.
  template <class Frame, class DoNext, class CheckContent>
  Result<Next> next(std::string_view what, Frame& frame, const DoNext& do_next,
                    const CheckContent& check_content) {
    if (ended_) {
      return Next::kEnd;
    }
    Result<Next> answer = do_next();
    if (answer && *answer == Next::kFrame) {
      if (const Status good = check(what, frame, check_content); !good) {
        answer = good.error();
      }
    }
    if (!answer) {
      frame.clear();
    }
    ended_ = answer && *answer == Next::kEnd;
    return answer;
  }
  /// Whether it may follow the ones before it, which are those that passed.
  template <class CheckContent>
  Status check(std::string_view what, const FrameHeader& frame, const CheckContent& check_content) {
    Status good = check_order(what, frame);
    if (good) {
      good = check_content();
    }
    if (good) {
      good = check_pose(what, frame);
    }
    if (good) {
      last_ = {frame.time, frame.sequence, frame.map_epoch};
    }
    return good;
  }

 private:
  struct Last {
    std::optional<Timestamp> time;
    std::int64_t sequence = -1;
    std::int64_t map_epoch = std::numeric_limits<std::int64_t>::min();
  };
  Last last_;
  bool ended_ = false;

  [[nodiscard]] Status check_order(std::string_view what, const FrameHeader& frame) const;
  [[nodiscard]] static Status check_pose(std::string_view what, const FrameHeader& frame);
};

/// Whether the `which` image of the stream `what` has its calibration's size and as many pixels.
template <class Value>
[[nodiscard]] Status check_size(std::string_view what, std::string_view which,
                                const PlainImage<Value>& image, int width_px, int height_px) {
  const std::size_t expected =
      static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  const bool fits = image.width_px == width_px && image.height_px == height_px;
  if (fits && image.pixels.size() == expected) {
    return {};
  }
  const std::string name = std::string(what) + ": " + std::string(which);
  const auto text = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height) + " px";
  };
  if (!fits) {
    return Error{name + " image is " + text(image.width_px, image.height_px) +
                 ", its calibration " + text(width_px, height_px)};
  }
  return Error{name + " image holds " + std::to_string(image.pixels.size() * sizeof(Value)) +
               " bytes, must be " + std::to_string(expected * sizeof(Value))};
}

}  // namespace orthonav
