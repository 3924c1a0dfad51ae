#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "base/time.h"
#include "engine/live/surface_contours.h"

namespace orthonav::engine {

/// The scale of a matrix of rotation, translation and uniform scale.
[[nodiscard]] float scale_of(const render::Matrix4& m);

/// Two ends of a straight piece, metres, in the world.
using StraightPiece = std::array<render::Float3, 2>;
/// Appends the pieces between the points of a line.
void append_pieces(const SurfaceContours::Line& line, std::vector<StraightPiece>& pieces);

/// How exactly a surface is drawn with lines, and how often they are updated.
struct BoneLineOptions {
  std::size_t most_pieces = 130;
  float within_m = 0.00035f;  ///< of the contour, while there are not too many pieces
  /// Lines are found anew once the eye has moved so far around the surface, or the surface has
  /// moved at all, but no sooner than after `at_most_every`: each time nearly all pieces move.
  float rotation_rad = 0.0175f;
  Duration at_most_every = std::chrono::milliseconds(100);
};

/// Surfaces drawn with lines: their contours, as the wearer's head sees them. Contours hardly move
/// with the head, since a line of sight that touches a round surface then touches it nearby:
/// slightly old lines are off by the square of the angle.
class BoneLines {
 public:
  explicit BoneLines(const BoneLineOptions& options = {}) : options_(options) {}

  /// The pieces of a surface for an eye in the world; unchanged while they are still good enough.
  /// Valid until the next call.
  [[nodiscard]] const std::vector<StraightPiece>& pieces(const render::MeshItem& item,
                                                         render::Float3 eye, Timestamp now);
  /// Forgets surfaces that were not requested since the last call.
  void forget_unused();

 private:
  struct Drawn {
    std::shared_ptr<const render::MeshData> mesh;
    render::Label label = 0;
    SurfaceContours contours;
    render::Matrix4 world_from_model = render::kIdentity;
    render::Float3 eye{};
    std::optional<Timestamp> found_at;
    std::vector<StraightPiece> pieces;
    bool used = true;
    explicit Drawn(const render::MeshItem& item)
        : mesh(item.mesh), label(item.label), contours(*item.mesh) {}
  };
  Drawn& drawn_of(const render::MeshItem& item);
  [[nodiscard]] bool will_do(const Drawn& drawn, const render::MeshItem& item, render::Float3 eye,
                             Timestamp now) const;
  void find(Drawn& drawn, const render::MeshItem& item, render::Float3 eye) const;

  BoneLineOptions options_;
  std::vector<std::unique_ptr<Drawn>> drawn_;
};

}  // namespace orthonav::engine
