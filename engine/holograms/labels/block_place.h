#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/time.h"
#include "engine/holograms/labels/label_geometry.h"
#include "engine/holograms/labels/label_obstacles.h"
#include "engine/holograms/labels/place_history.h"
#include "engine/holograms/shapes/hologram_cross.h"
#include "render/scene.h"
#include "render/text/font.h"

namespace orthonav::engine {

/// Texts that move together.
enum class PlacedBlock {
  kStatus,  ///< all rows that hang on the head (H11)
  kCross    ///< the target cross with everything that is written about it (H6, H7, H9, H13)
};

/// Moves a block to where both eyes see it whole and it covers nothing: turned about the eyes, so
/// that its size stays. In this order it makes way for the edge of the view, the status line, the
/// wound, the trajectory, the tool and white paper; of places that are alike it takes the nearest.
///
/// The status line goes aside rather than up: above it is the wound, of which a scene knows what is
/// stroked and where screws enter.
///
/// Where no place is in view, the numbers that were asked for are left out first, then the cross:
/// it is never cut. The status line is always shown. A blocked place is left at once, any other
/// only after a better one has been free for a second. Deterministic; once warm it allocates
/// nothing. One thread at a time.
class BlockPlace {
 public:
  static constexpr float kStep_rad = 0.035f;  ///< 2°
  static constexpr int kAside = 9;            ///< steps to either side
  static constexpr int kUp = 7;               ///< steps up or down

  explicit BlockPlace(PlacedBlock block) : block_(block) {}

  /// Call once per scene: the status line first, then the cross, then other labels are laid out.
  void lay_out(render::Scene& scene, const Eyes& eyes, std::span<const GlarePatch> patches,
               Timestamp shown_at);

 private:
  /// The block in a plane that faces the eyes: from its middle to the right and up, metres.
  struct Extent {
    float left = 0;
    float bottom = 0;
    float right = 0;
    float top = 0;
  };
  struct Best {
    std::size_t place = 0;
    int cost = 0;
  };

  bool find_middle(const render::Scene& scene, const Eyes& eyes);
  void find_rows(const render::Scene& scene, const Eyes& eyes);
  [[nodiscard]] Extent extent_of(const render::Scene& scene, const Eyes& eyes) const;
  void settle(const Eyes& eyes, Timestamp now);
  [[nodiscard]] int cost_of(std::size_t place, const Eyes& eyes, float margin) const;
  [[nodiscard]] Best best_of(const Eyes& eyes, std::optional<std::size_t> without) const;

  PlacedBlock block_;
  render::Font font_;
  std::vector<BoxInEyes> rows_;
  std::vector<LabelObstacle> obstacles_;
  render::Float3 middle_{};  ///< of the rings or of the status line's first row, as built
  float radius_m_ = 0;       ///< of the rings
  render::Float3 right_{};   ///< of the block's plane, unit
  render::Float3 up_{};
  Extent extent_;
  PlaceHistory history_;
  Timestamp seen_ = Timestamp::min();
};

/// Adds an arrow at the edge of the view, towards the entry that is guided to, where that is out of
/// view of either eye.
void point_to_entry(render::Scene& scene, const Eyes& eyes);

}  // namespace orthonav::engine
