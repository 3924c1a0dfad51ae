#include "engine/holograms/label_judge.h"

#include <algorithm>
#include <tuple>

#include "engine/holograms/hologram_cross.h"
#include "engine/holograms/hologram_label.h"
#include "engine/holograms/rod_in_hand_hologram.h"
#include "render/float3.h"
#include "render/frame/frame_items.h"

namespace orthonav::engine {
namespace {

using render::Float3;
using render::TextItem;

// The harm where no place is free: two texts are lost, a place is hidden, a text is hard to read.
constexpr int kOverNamed = 4;
constexpr int kOverPaper = 2;
constexpr int kOverLeader = 1;
constexpr int kBlocked = 1000;  // times the harm
constexpr int kOverLine = 10;   // more than any place nearby costs
constexpr int kOutOfView = 12;
constexpr int kLed = 20;
constexpr int kGuidingOutOfView = 60;  // also of what is to be done next; more than a leader costs
constexpr float kLeaderRadius_m = 0.0003f;
// Height of the depth's place, kept free under an angle that has no depth at the moment.
constexpr float kDepthCaps = 4.0f / 7.0f;
constexpr float kDepthWidth = 9.0f;

float cap_m(const render::Matrix4& world_from_caps) {
  return render::length({world_from_caps[0], world_from_caps[1], world_from_caps[2]});
}

LabelPlace as_built(const TextItem& text) { return place_of(text, {}, 0); }

/// A depth and the angle that it belongs under.
bool belong_together(const TextItem& depth, const TextItem& angle) {
  return kind_of(depth.label) == HologramKind::kDepth &&
         kind_of(angle.label) == HologramKind::kAngle &&
         instance_of(depth.label) == instance_of(angle.label);
}

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
    const bool follows =
        std::any_of(scene.texts.begin(), scene.texts.end(),
                    [&](const auto& other) { return belong_together(item, other); });
    if (!follows) {
      placed_.push_back(eyes_.box(subject.world_from_caps, box_at(as_built(item), subject.extent)));
    }
    return;
  }
  subject.instance = static_cast<std::uint32_t>(
      std::count_if(subjects_.begin(), subjects_.end(), [&](const LabelSubject& other) {
        return other.rank == subject.rank && scene.texts[other.text].label == item.label;
      }));
  if (subject.rank == LabelRank::kGuiding) {
    put_under(scene, subject);
  }
  subjects_.push_back(subject);
}

/// The block of angle and depth, in cap heights of the angle.
void LabelJudge::put_under(const render::Scene& scene, LabelSubject& subject) const {
  float width = kDepthWidth;
  subject.below_caps = kDepthCaps;
  for (std::size_t i = 0; i < scene.texts.size(); ++i) {
    const TextItem& item = scene.texts[i];
    if (belong_together(item, scene.texts[subject.text])) {
      subject.below = i;
      subject.below_caps =
          cap_m(render::world_from_caps(item, eyes_.head())) / cap_m(subject.world_from_caps);
      width = std::max(width, render::line_width(font_, item));
    }
  }
  subject.extent.width = std::max(subject.extent.width, subject.below_caps * width);
  subject.extent.below = subject.below_caps * (kDepthBelowAngle + subject.extent.below);
}

int LabelJudge::harm(const LabelObstacle& obstacle, render::Label label, LabelRank rank,
                     const Spot& spot) {
  const bool guides = rank == LabelRank::kGuiding;
  switch (obstacle.kind) {
    case LabelObstacle::Kind::kNamed: {
      const bool own = obstacle.label == label;
      return overlap(obstacle.seen, own ? spot.from_own : spot.from_others) ? kOverNamed : 0;
    }
    case LabelObstacle::Kind::kWound:
      return guides && overlap(obstacle.seen, spot.from_own) ? kTextLost : 0;
    case LabelObstacle::Kind::kGlare:
      return overlap(obstacle.seen, spot.from_others) ? (guides ? kTextLost : kOverPaper) : 0;
    case LabelObstacle::Kind::kLeader:
      return overlap(obstacle.seen, spot.from_others) ? kOverLeader : 0;
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
    verdict.blocked += harm(obstacle, item.label, subject.rank, spot);
  }
  for (const BoxInEyes& other : placed_) {
    verdict.blocked += overlap(other, spot.from_others) ? kTextLost : 0;
  }
  if (at.led) {
    const OutlineInEyes line = eyes_.outline(leader(subject, at), kLeaderRadius_m);
    verdict.blocked += kOverLeader * crossed(line, margins.own);
  }
  const bool instructs = subject.rank == LabelRank::kGuiding || item.label == kRodInHandLabel;
  const int out_of_view = instructs ? kGuidingOutOfView : kOutOfView;
  verdict.cost = kBlocked * verdict.blocked + (over_line ? kOverLine : 0) + (at.led ? kLed : 0) +
                 (eyes_.in_view(box) ? 0 : out_of_view) + static_cast<int>(place);
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
