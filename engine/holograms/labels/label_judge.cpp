#include "engine/holograms/labels/label_judge.h"

#include <algorithm>
#include <tuple>

#include "engine/holograms/shapes/hologram_label.h"
#include "render/float3.h"
#include "render/frame/frame_items.h"

namespace orthonav::engine {
namespace {

using render::Float3;
using render::TextItem;

// The harm where no place is free: two texts are lost, a place is hidden, a text is hard to read.
constexpr int kOverPaper = 2;
constexpr int kOverLeader = 1;
constexpr int kBlocked = 1000;        // times the harm
constexpr int kOverLine = 10;         // more than any place nearby costs
constexpr int kCut = 100 * kBlocked;  // worse than whatever else
constexpr int kLed = 20;
constexpr float kLeaderRadius_m = 0.0003f;
/// To the edge of a view: a digit's width.
constexpr float kLabelEdge = 0.006f;

LabelPlace as_built(const TextItem& text) { return place_of(text, {}, 0); }

}  // namespace

void LabelJudge::begin(const render::Scene& scene, const std::vector<render::View>& views,
                       std::span<const GlarePatch> patches) {
  eyes_ = Eyes(views);
  find_obstacles(scene, patches, eyes_, obstacles_);
  placed_.clear();
  subjects_.clear();
  for (std::size_t text = 0; text < scene.texts.size(); ++text) {
    add_subject(scene, text);
  }
  std::sort(subjects_.begin(), subjects_.end(), [&](const auto& a, const auto& b) {
    const auto order = [&](const LabelSubject& s) {
      return std::tuple(s.rank, scene.texts[s.text].label, s.instance);
    };
    return order(a) < order(b);
  });
}

void LabelJudge::add_subject(const render::Scene& scene, std::size_t text) {
  const TextItem& item = scene.texts[text];
  LabelSubject subject;
  subject.text = text;
  subject.rank = rank_of(item);
  subject.world_from_caps = render::world_from_caps(item, eyes_.head());
  subject.extent.width = render::line_width(font_, item);
  if (subject.rank == LabelRank::kFixed) {
    placed_.push_back(eyes_.box(subject.world_from_caps, box_at(as_built(item), subject.extent)));
    return;
  }
  subject.instance = static_cast<std::uint32_t>(
      std::count_if(subjects_.begin(), subjects_.end(), [&](const LabelSubject& other) {
        return other.rank == subject.rank && scene.texts[other.text].label == item.label;
      }));
  subjects_.push_back(subject);
}

int LabelJudge::harm(const LabelObstacle& obstacle, render::Label label, const Spot& spot) {
  switch (obstacle.kind) {
    case LabelObstacle::Kind::kNamed: {
      const bool own = obstacle.label == label;
      return overlap(obstacle.seen, own ? spot.from_own : spot.from_others) ? kPlaceHidden : 0;
    }
    case LabelObstacle::Kind::kGlare:
      return overlap(obstacle.seen, spot.from_others) ? kOverPaper : 0;
    case LabelObstacle::Kind::kLeader:
      return overlap(obstacle.seen, spot.from_others) ? kOverLeader : 0;
    case LabelObstacle::Kind::kWound:
    case LabelObstacle::Kind::kLine:
      break;
  }
  return 0;
}

/// The number of labels that a leader would cross.
int LabelJudge::crossed(const OutlineInEyes& leader, float margin) const {
  const auto count = std::count_if(placed_.begin(), placed_.end(), [&](const BoxInEyes& box) {
    return overlap(leader, grown(box, margin));
  });
  return static_cast<int>(count);
}

LabelVerdict LabelJudge::judge(const render::Scene& scene, const LabelSubject& subject,
                               std::size_t place, const LabelMargins& margins) const {
  const TextItem& item = scene.texts[subject.text];
  const LabelPlace at = place_of(item, subject.extent, place);
  const BoxInEyes box = eyes_.box(subject.world_from_caps, box_at(at, subject.extent));
  const Spot spot{box, grown(box, margins.others), grown(box, margins.own)};
  LabelVerdict verdict;
  bool over_line = false;
  for (const LabelObstacle& obstacle : obstacles_) {
    over_line |= obstacle.kind == LabelObstacle::Kind::kLine && overlap(obstacle.seen, box);
    verdict.blocked += harm(obstacle, item.label, spot);
  }
  for (const BoxInEyes& other : placed_) {
    verdict.blocked += overlap(other, spot.from_others) ? kTextLost : 0;
  }
  if (at.led) {
    const OutlineInEyes line = eyes_.outline(leader(subject, at), kLeaderRadius_m);
    verdict.blocked += kOverLeader * crossed(line, margins.own);
  }
  verdict.cut = !eyes_.in_view(grown(box, kLabelEdge));
  verdict.cost = kBlocked * verdict.blocked + (over_line ? kOverLine : 0) + (at.led ? kLed : 0) +
                 (verdict.cut ? kCut : 0) + static_cast<int>(place);
  return verdict;
}

void LabelJudge::occupy(const render::Scene& scene, const LabelSubject& subject,
                        std::size_t place) {
  const TextItem& item = scene.texts[subject.text];
  const LabelPlace at = place_of(item, subject.extent, place);
  placed_.push_back(eyes_.box(subject.world_from_caps, box_at(at, subject.extent)));
  if (at.led) {
    obstacles_.push_back({LabelObstacle::Kind::kLeader, item.label,
                          eyes_.outline(leader(subject, at), kLeaderRadius_m)});
  }
}

std::array<Float3, 2> LabelJudge::leader(const LabelSubject& subject, const LabelPlace& place) {
  constexpr float kGap = 0.15f;    // before the text, cap heights
  constexpr float kAnchor = 0.8f;  // clear of what is named
  const CapsBox box = box_at(place, {subject.extent.width, 0, 0, 1});
  Float3 to{std::clamp(0.0f, box.left - kGap, box.right + kGap),
            std::clamp(0.0f, box.bottom - kGap, box.top + kGap), 0};
  const float away = render::length(to);
  const Float3 from = std::min(1.0f, kAnchor / std::max(away, kAnchor)) * to;
  return {render::transformed(subject.world_from_caps, from),
          render::transformed(subject.world_from_caps, to)};
}

}  // namespace orthonav::engine
