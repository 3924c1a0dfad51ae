#pragma once

#include <optional>
#include <vector>

#include "bench/other_renderer.h"
#include "bench/other_texture.h"

namespace orthonav::bench {

/// One camera at one moment, and the light that comes along its rays.
class OtherView {
 public:
  OtherView(const Moment& moment, const Transform<LeftCamera, Rig>& camera_from_rig,
            std::span<const DrawnTag> tags, const Lighting& lighting, const Clutter& clutter);
  /// For a ray, given by its point on the unit plane.
  [[nodiscard]] float light(Vec2 ray) const;
  /// The same from background and finger only.
  [[nodiscard]] float light_behind_tags(Vec2 ray) const;
  [[nodiscard]] bool is_behind_finger(Vec2 ray) const { return finger_depth(ray).has_value(); }
  /// Cosine of the angle at which the camera sees a point of a tag; negative from behind.
  [[nodiscard]] double cosine(std::size_t tag, Vec3 in_marker_m) const;

 private:
  struct TagSeen {
    const DrawnTag* tag = nullptr;
    Mat3 marker_from_camera;
    Vec3 eye;  ///< in the marker's frame, as is the lamp
    Vec3 lamp;
    double half_paper_m = 0.0;
  };
  [[nodiscard]] float tag_light(const TagSeen& seen, double x, double y) const;
  [[nodiscard]] std::optional<double> finger_depth(Vec2 ray) const;

  const Lighting& lighting_;
  const Clutter& clutter_;
  std::vector<TagSeen> tags_;
  std::optional<Finger> finger_;
  Mat3 world_from_camera_;
  Vec3 eye_;  ///< in World
};

}  // namespace orthonav::bench
