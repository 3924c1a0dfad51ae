#include "engine/holograms/labels/label_layout.h"

#include <algorithm>
#include <utility>

#include "engine/holograms/shapes/hologram_parts.h"

namespace orthonav::engine {
namespace {

// The difference between the two is more than a tracked head trembles.
constexpr LabelMargins kToStay = {0.0010f, -0.0008f};  // within the free margin around ink
constexpr LabelMargins kToCome = {0.0035f, 0.0f};

constexpr float kLeaderWidth_m = 0.0004f;
constexpr float kLeaderOpacity = 0.6f;

}  // namespace

void LabelLayout::lay_out(render::Scene& scene, const std::vector<render::View>& views,
                          std::span<const GlarePatch> patches, Timestamp shown_at) {
  if (views.empty()) {
    return;
  }
  forget(shown_at);
  const Eyes eyes(views);
  point_to_entry(scene, eyes);
  status_.lay_out(scene, eyes, patches, shown_at);
  cross_.lay_out(scene, eyes, patches, shown_at);
  judge_.begin(scene, views, patches);
  for (const LabelSubject& subject : judge_.subjects()) {
    Kept& kept = kept_of(scene.texts[subject.text].label, subject);
    settle(scene, subject, kept);
    if (kept.place) {
      judge_.occupy(scene, subject, *kept.place);
    }
    write(scene, subject, kept);
  }
}

void LabelLayout::forget(Timestamp shown_at) {
  const bool jumped = shown_at < now_ || shown_at - kForgetPlacesAfter > now_;
  now_ = shown_at;
  std::erase_if(
      kept_, [&](const Kept& kept) { return jumped || kept.seen < shown_at - kForgetPlacesAfter; });
}

LabelLayout::Kept& LabelLayout::kept_of(render::Label label, const LabelSubject& subject) {
  for (Kept& kept : kept_) {
    if (kept.label == label && kept.rank == subject.rank && kept.instance == subject.instance) {
      return kept;
    }
  }
  Kept& added = kept_.emplace_back();
  added.label = label;
  added.rank = subject.rank;
  added.instance = subject.instance;
  return added;
}

LabelLayout::Best LabelLayout::best_of(const render::Scene& scene, const LabelSubject& subject,
                                       std::optional<std::size_t> without) const {
  std::optional<Best> best;
  const std::size_t count = count_of_places();
  for (std::size_t place = 0; place < count; ++place) {
    // Later places cost more even when they are free.
    if (place == without || (best && best->verdict.cost <= static_cast<int>(place))) {
      continue;
    }
    const LabelVerdict verdict = judge_.judge(scene, subject, place, kToCome);
    if (!best || verdict.cost < best->verdict.cost) {
      best = Best{place, verdict};
    }
  }
  return *best;
}

/// Where to move at once: not to the place that it just left, unless a text would be lost
/// everywhere else.
LabelLayout::Best LabelLayout::refuge_of(const render::Scene& scene, const LabelSubject& subject,
                                         const Kept& kept, const Best& best) const {
  if (!kept.just_left(best.place, now_)) {
    return best;
  }
  const Best other = best_of(scene, subject, kept.before);
  return other.verdict.blocked < kTextLost ? other : best;
}

void LabelLayout::settle(const render::Scene& scene, const LabelSubject& subject, Kept& kept) {
  kept.seen = now_;
  const Best best = best_of(scene, subject, std::nullopt);
  // What an edge would cut, or could not be read, is left out.
  const bool may_be_left_out = best.verdict.cut || best.verdict.blocked >= kPlaceHidden ||
                               subject.rank == LabelRank::kIncidental;
  const bool room = best.verdict.blocked == 0 && !best.verdict.cut;
  if (std::exchange(kept.is_new, false)) {
    kept.place = room || !may_be_left_out ? std::optional(best.place) : std::nullopt;
    return;
  }
  if (!kept.place) {
    room || !may_be_left_out ? kept.wait_for(best.place, now_) : kept.better.reset();
    return;
  }
  const LabelVerdict here = judge_.judge(scene, subject, *kept.place, kToStay);
  if ((here.blocked > 0 || here.cut) && may_be_left_out && !room) {
    return kept.move(std::nullopt, now_);
  }
  if (here.cut && !best.verdict.cut) {
    return kept.move(best.place, now_);
  }
  if (here.blocked > best.verdict.blocked) {
    const Best refuge = refuge_of(scene, subject, kept, best);
    if (here.blocked > refuge.verdict.blocked) {
      return kept.move(refuge.place, now_);
    }
  }
  if (best.verdict.cost < here.cost) {
    kept.wait_for(best.place, now_);
  } else {
    kept.better.reset();
  }
}

void LabelLayout::write(render::Scene& scene, const LabelSubject& subject, const Kept& kept) {
  render::TextItem& text = scene.texts[subject.text];
  if (!kept.place) {
    text.runs.clear();
    return;
  }
  const LabelPlace at = place_of(text, subject.extent, *kept.place);
  if (at.mine) {
    return;
  }
  text.align = at.align;
  text.offset_right = at.right;
  text.offset_up = at.up;
  if (at.led && !text.runs.empty()) {
    const auto ends = LabelJudge::leader(subject, at);
    add_line(scene, ends, kLeaderWidth_m, faded(text.runs.front().colour, kLeaderOpacity),
             text.label);
  }
}

}  // namespace orthonav::engine
