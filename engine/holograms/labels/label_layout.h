#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/time.h"
#include "engine/holograms/labels/block_place.h"
#include "engine/holograms/labels/label_judge.h"
#include "engine/holograms/labels/place_history.h"

namespace orthonav::engine {

/// Moves the texts of a scene so that, for either eye, none covers another one, the thing that
/// another one names, or a printed tag. The most important is placed first (LabelRank). A label
/// without room nearby is placed farther off with a thin line; an incidental one is left out, as is
/// any that the edge of a view would cut. Before them the status line and the target cross find
/// their places (BlockPlace).
///
/// Places change with hysteresis: a blocked one is left at once, any other only after a better one
/// has been free for `kSettled`. A label jumps from one frame to the next, since it would cross
/// others on its way. Deterministic; once warm it allocates nothing. One thread at a time.
class LabelLayout {
 public:
  static constexpr Duration kSettled = kPlaceSettled;

  /// Lays out a scene from the builder; call once per scene. `shown_at` measures how long a place
  /// has been free; history later than that, or more than two seconds before it, is forgotten.
  void lay_out(render::Scene& scene, const std::vector<render::View>& views,
               std::span<const GlarePatch> patches, Timestamp shown_at);

 private:
  /// A label's history in earlier frames.
  struct Kept : PlaceHistory {  // no place: left out
    render::Label label = 0;
    LabelRank rank = LabelRank::kFixed;
    std::uint32_t instance = 0;
    Timestamp seen{};
    bool is_new = true;
  };
  struct Best {
    std::size_t place = 0;
    LabelVerdict verdict;
  };

  void forget(Timestamp shown_at);
  Kept& kept_of(render::Label label, const LabelSubject& subject);
  void settle(const render::Scene& scene, const LabelSubject& subject, Kept& kept);
  [[nodiscard]] Best best_of(const render::Scene& scene, const LabelSubject& subject,
                             std::optional<std::size_t> without) const;
  [[nodiscard]] Best refuge_of(const render::Scene& scene, const LabelSubject& subject,
                               const Kept& kept, const Best& best) const;
  static void write(render::Scene& scene, const LabelSubject& subject, const Kept& kept);

  BlockPlace status_{PlacedBlock::kStatus};
  BlockPlace cross_{PlacedBlock::kCross};
  LabelJudge judge_;
  Timestamp now_ = Timestamp::min();
  std::vector<Kept> kept_;
};

}  // namespace orthonav::engine
