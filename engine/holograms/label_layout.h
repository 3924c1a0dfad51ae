#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/time.h"
#include "engine/holograms/label_judge.h"

namespace orthonav::engine {

/// Moves the texts of a scene so that, for either eye, none lies over another, over what another
/// names, or over a printed tag. The most important is placed first (LabelRank). A label that finds
/// no room nearby stands farther off with a thin line; an incidental one is left out.
///
/// Places change with hysteresis: one that is blocked is left at once, any other only after a
/// better one has been free for `kSettled`. A label moves from one frame to the next: on its way it
/// would cross others. Deterministic; once warm it allocates nothing. One thread at a time.
class LabelLayout {
 public:
  /// For so long a better place must have been free before a label takes it, and a label does not
  /// go back to the place that it left while there is another.
  static constexpr Duration kSettled = std::chrono::seconds(1);

  /// Of a scene as the builder wrote it, once. `shown_at` says how long a place has been free; what
  /// was shown later than that, or more than two seconds before it, is forgotten.
  void lay_out(render::Scene& scene, const std::vector<render::View>& views,
               std::span<const GlarePatch> patches, Timestamp shown_at);

 private:
  /// What became of a label in the frames before.
  struct Kept {
    render::Label label = 0;
    LabelRank rank = LabelRank::kFixed;
    std::uint32_t instance = 0;
    std::optional<std::size_t> place;  ///< none: left out
    std::optional<std::size_t> better;
    Timestamp better_since{};
    std::optional<std::size_t> before;  ///< the place that it left
    Timestamp left_at{};
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
  void wait_for(Kept& kept, std::size_t place);
  void move(Kept& kept, std::optional<std::size_t> place) const;
  [[nodiscard]] Best best_of(const render::Scene& scene, const LabelSubject& subject,
                             std::optional<std::size_t> without) const;
  [[nodiscard]] Best refuge_of(const render::Scene& scene, const LabelSubject& subject,
                               const Kept& kept, const Best& best) const;
  static void write(render::Scene& scene, const LabelSubject& subject, const Kept& kept);

  LabelJudge judge_;
  Timestamp now_ = Timestamp::min();
  std::vector<Kept> kept_;
};

}  // namespace orthonav::engine
