#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/time.h"
#include "engine/holograms/hologram_cross.h"
#include "engine/holograms/label_geometry.h"
#include "engine/holograms/label_judge.h"
#include "engine/holograms/label_obstacles.h"
#include "engine/holograms/place_history.h"
#include "render/scene.h"
#include "render/text/font.h"

namespace orthonav::engine {

/// Keeps the target cross and the numbers under it (H7, H13) clear of the rows that hang on the
/// head (H11 and the row above it). Where they meet, the whole block is turned upwards about the
/// eyes by as many steps as that takes, so that it keeps its size and faces them. A higher place is
/// preferred if the block would otherwise cover an entry point, a rod's head or a check point.
///
/// With the hysteresis of LabelLayout: up at once, down after a second of room; a block with
/// nothing in its way stays exactly where it was built. Deterministic; once warm it
/// allocates nothing. One thread at a time.
class CrossLift {
 public:
  static constexpr float kStep_rad = 0.026f;  ///< 1.5°, more than a row of the numbers
  /// The last step lifts the lowest number over the rows even when the cross is just below them.
  static constexpr std::size_t kPlaces = 15;

  /// Call once per scene, before other labels are laid out.
  void lay_out(render::Scene& scene, const Eyes& eyes, Timestamp shown_at);

 private:
  /// A text of the block, or the square around its rings.
  struct Part {
    render::Float3 position;
    float height_m = 0;
    float min_height_deg = 0;
    CapsBox box;
  };
  struct Best {
    std::size_t place = 0;
    LabelVerdict verdict;
  };

  void find_parts(const render::Scene& scene, const Eyes& eyes, const CrossDisc& disc);
  void settle(const render::Scene& scene, const Eyes& eyes, Timestamp now);
  [[nodiscard]] LabelVerdict judge(std::size_t place, const Eyes& eyes, float margin) const;
  [[nodiscard]] Best best_of(const Eyes& eyes, std::optional<std::size_t> without) const;

  render::Font font_;
  std::vector<Part> parts_;
  std::vector<BoxInEyes> rows_;
  std::vector<LabelObstacle> obstacles_;
  render::Float3 middle_{};  ///< of the rings, as built
  PlaceHistory history_;
  Timestamp seen_ = Timestamp::min();
};

}  // namespace orthonav::engine
