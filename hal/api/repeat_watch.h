#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/image.h"
#include "base/transform.h"

namespace orthonav {

/// What of a pair is the same as before, although its stamp is new. A sensor's noise never repeats:
/// it is an old picture, or an old pose.
enum class Repeated : std::uint8_t { kLeftPicture, kRightPicture, kBothPictures, kHeadPose };

/// Nothing if neither picture repeats.
[[nodiscard]] std::optional<Repeated> of_pictures(bool left, bool right);
/// "the left camera repeats its picture": for messages.
[[nodiscard]] const char* text_of(Repeated repeated);

/// What may be the same from pair to pair since no sensor stands behind it: a simulation without
/// noise, at rest. Only the device itself knows.
struct MayRepeat {
  bool pictures = false;
  bool head_pose = false;

  friend bool operator==(const MayRepeat&, const MayRepeat&) = default;
};

/// Notices what repeats in a stream of pairs: a camera that stands still, one that delivers a few
/// old pictures over and over, and a head whose pose stands still while the pictures change.
class RepeatWatch {
 public:
  /// What of the next pair repeats. `told` is what its device knows itself, as of a picture that
  /// was coded anew. After two pairs in a row with repeats, one more is not trusted: a picture that
  /// stands still looks new once when its coding begins anew.
  std::optional<Repeated> look(const GreyImage& left, const GreyImage& right,
                               const std::optional<Transform<World, Rig>>& world_from_rig,
                               MayRepeat may, std::optional<Repeated> told);

 private:
  /// The hashes of half a second of different pictures.
  class Pictures {
   public:
    bool repeats(const GreyImage& picture);

   private:
    std::array<std::uint64_t, 16> hashes_{};
    std::size_t count_ = 0;
  };
  std::optional<Repeated> repeated(const GreyImage& left, const GreyImage& right,
                                   const std::optional<Transform<World, Rig>>& world_from_rig,
                                   MayRepeat may, std::optional<Repeated> told);

  Pictures left_;
  Pictures right_;
  std::optional<Transform<World, Rig>> last_pose_;
  int in_a_row_ = 0;
  Repeated last_ = Repeated::kLeftPicture;
};

}  // namespace orthonav
