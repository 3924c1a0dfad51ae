#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "hal/sim/cameras/tag_pattern.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

using Tint = std::array<float, 3>;

/// Fraction of the light that a surface returns, 0 to 1. Printed black and white give greys of
/// about 30 and 200 under the lamp.
inline constexpr float kWhiteAlbedo = 0.80F;
inline constexpr float kBlackAlbedo = 0.12F;
/// Grey of a white surface that faces the lamp.
inline constexpr float kFullGrey = 250.0F;

/// A tag's square plate in the camera frame. Its face is +z of Marker.
struct Plate {
  Transform<LeftCamera, Marker> camera_from_marker;
  const TagPattern* pattern = nullptr;  ///< null: blank
  double cell_m = 0.0;
  double half_m = 0.0;  ///< half the plate's width, quiet zone and margin included
  float light = 1.0F;
  int tool = 0;
  float glare = 0.0F;               ///< mirrored light, as a fraction of a white plate's
  const TagFlaws* flaws = nullptr;  ///< never null once gathered
  double size_m = 0.0;              ///< of the tag
};

/// A tapered rod with round ends in the camera frame.
struct Capsule {
  Vec3 a;
  Vec3 b;
  double radius_a_m = 0.0;
  double radius_b_m = 0.0;
  float albedo = 0.5F;
  float gloss = 0.0F;
  Tint tint{1, 1, 1};
  int tool = -1;  ///< the hand: -1; a screw: beyond all tools
  int rank = 0;   ///< decides within one tool; above 1 it lies on the face of the plate
};

struct Solids {
  Vec3 lamp_in_camera{0, -1, 0};  ///< unit, towards the lamp
  std::vector<Plate> plates;
  std::vector<Capsule> capsules;
};

/// Tools, hand and the heads of standing screws as bodies. Built once per room; `gather` reuses the
/// vectors given.
class ToolBodies {
 public:
  explicit ToolBodies(const RoomDescription& room);
  /// Everything in front of the camera at that moment. `gloss`: of the tags' faces.
  void gather(const RoomState& state, const Transform<LeftCamera, Room>& camera_from_room,
              Solids& solids, double gloss) const;

 private:
  struct Body {
    std::optional<TagPattern> pattern;
    double cell_m = 0.0;
    double half_m = 0.0;
    double size_m = 0.0;
    TagFlaws flaws;
    std::vector<Capsule> rods;  ///< in Marker; drops on its face too
  };
  /// One tool: its plate and its rods.
  void add_tool(std::size_t tool, const Transform<Room, Marker>& room_from_marker,
                const Transform<LeftCamera, Room>& camera_from_room, Vec3 viewer, double gloss,
                Solids& solids) const;

  /// A standing screw's neck and head, in its Vertebra.
  struct Head {
    std::size_t level = 0;
    std::array<Capsule, 2> parts;
  };

  std::vector<Body> bodies_;
  std::vector<Head> heads_;
};

}  // namespace orthonav::sim
