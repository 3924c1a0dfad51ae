#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/holograms/labels/label_geometry.h"
#include "engine/holograms/labels/label_obstacles.h"
#include "engine/holograms/labels/label_places.h"
#include "render/text/font.h"

namespace orthonav::engine {

/// A text of a scene to be placed.
struct LabelSubject {
  std::size_t text = 0;  ///< an index into the scene's texts
  LabelRank rank = LabelRank::kFixed;
  std::uint32_t instance = 0;  ///< among the texts of its label and rank
  LabelExtent extent;
  render::Matrix4 world_from_caps{};
};

/// The least harm of a place where this or another text becomes unreadable, or hides what another
/// one names.
inline constexpr int kTextLost = 8;
inline constexpr int kPlaceHidden = 4;

/// How good a place is.
struct LabelVerdict {
  int blocked = 0;   ///< the harm of covering other things; 0: the place is free
  int cost = 0;      ///< less is better; any blocked place costs more than all free ones
  bool cut = false;  ///< by the edge of a view
};

/// Minimum distances, tangents of visual angles.
struct LabelMargins {
  float others = 0;  ///< to other texts and the things they name
  float own = 0;     ///< to the thing that the label itself names
};

/// Judges what a label would cover at a place in one frame. Keeps its buffers between frames.
class LabelJudge {
 public:
  /// Sets the eyes, the obstacles, and the texts that must not be moved.
  void begin(const render::Scene& scene, const std::vector<render::View>& views,
             std::span<const GlarePatch> patches);
  /// The texts to be placed, the most important first. Valid until `begin`.
  [[nodiscard]] std::span<const LabelSubject> subjects() const { return subjects_; }

  [[nodiscard]] LabelVerdict judge(const render::Scene& scene, const LabelSubject& subject,
                                   std::size_t place, const LabelMargins& margins) const;
  /// From now on, other labels avoid it there.
  void occupy(const render::Scene& scene, const LabelSubject& subject, std::size_t place);
  /// The line from the named thing to the label, metres in the world.
  [[nodiscard]] static std::array<render::Float3, 2> leader(const LabelSubject& subject,
                                                            const LabelPlace& place);

 private:
  void add_subject(const render::Scene& scene, std::size_t text);
  /// A place in three sizes.
  struct Spot {
    BoxInEyes box;
    BoxInEyes from_others;
    BoxInEyes from_own;
  };
  [[nodiscard]] static int harm(const LabelObstacle& obstacle, render::Label label,
                                const Spot& spot);
  [[nodiscard]] int crossed(const OutlineInEyes& leader, float margin) const;

  render::Font font_;
  Eyes eyes_;
  std::vector<LabelObstacle> obstacles_;
  std::vector<BoxInEyes> placed_;
  std::vector<LabelSubject> subjects_;
};

}  // namespace orthonav::engine
