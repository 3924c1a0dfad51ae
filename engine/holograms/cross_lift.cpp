#include "engine/holograms/cross_lift.h"

#include <algorithm>
#include <cmath>

#include "engine/holograms/hologram_label.h"
#include "engine/holograms/label_places.h"
#include "render/float3.h"
#include "render/frame/frame_items.h"

namespace orthonav::engine {
namespace {

using render::Float3;
using render::TextItem;

constexpr render::Label kLifted = label_of(HologramKind::kCross, 1);
// The rows go with every move of the head, the block does not: it needs more room than labels that
// stand in the world need from each other. Tangents of visual angles.
constexpr float kRoomToStay = 0.0010f;
constexpr float kRoomToCome = 0.0105f;  // 0.6 degrees
constexpr int kOverRow = 1000;          // times the rows covered
constexpr int kOverPlace = 3;           // as many steps higher up are better

bool of_block(render::Label label) {
  return kind_of(label) == HologramKind::kCross || kind_of(label) == HologramKind::kNumbers;
}

bool of_block(const TextItem& text) {
  return text.place == render::TextPlace::kWorld && of_block(text.label);
}

/// Turns what is in the world about the eyes, so that this place goes up as they see it.
class TurnUp {
 public:
  TurnUp(const render::Head& head, Float3 place, float angle_rad)
      : eyes_(head.position),
        towards_(render::unit_or(head.position - place, head.back)),
        right_(render::unit_or(render::cross(head.up, towards_), head.right)),
        up_(render::cross(towards_, right_)),
        cos_(std::cos(angle_rad)),
        sin_(std::sin(angle_rad)) {}

  [[nodiscard]] Float3 place(Float3 p) const { return eyes_ + direction(p - eyes_); }
  [[nodiscard]] Float3 direction(Float3 v) const {
    const float up = dot(v, up_);
    const float towards = dot(v, towards_);
    return dot(v, right_) * right_ + (cos_ * up - sin_ * towards) * up_ +
           (cos_ * towards + sin_ * up) * towards_;
  }
  void turn(render::Matrix4& m) const {
    for (const std::size_t column : {0U, 4U, 8U}) {
      put(m, column, direction({m[column], m[column + 1], m[column + 2]}));
    }
    put(m, 12, place({m[12], m[13], m[14]}));
  }

 private:
  static void put(render::Matrix4& m, std::size_t at, Float3 v) {
    m[at] = v.x;
    m[at + 1] = v.y;
    m[at + 2] = v.z;
  }

  Float3 eyes_;
  Float3 towards_;
  Float3 right_;
  Float3 up_;
  float cos_;
  float sin_;
};

void turn_block(render::Scene& scene, const TurnUp& turn) {
  for (render::MeshItem& mesh : scene.meshes) {
    if (of_block(mesh.label)) {
      turn.turn(mesh.world_from_model);
    }
  }
  for (render::LineItem& line : scene.lines) {
    if (of_block(line.label)) {
      std::transform(line.points.begin(), line.points.end(), line.points.begin(),
                     [&](Float3 p) { return turn.place(p); });
    }
  }
  for (render::TriangleItem& triangle : scene.triangles) {
    if (of_block(triangle.label)) {
      for (Float3& corner : triangle.corners) {
        corner = turn.place(corner);
      }
    }
  }
  for (TextItem& text : scene.texts) {
    if (of_block(text)) {
      text.position = turn.place(text.position);
    }
  }
}

float angle_of(std::size_t place) { return CrossLift::kStep_rad * static_cast<float>(place); }

}  // namespace

void CrossLift::lay_out(render::Scene& scene, const Eyes& eyes, Timestamp shown_at) {
  const std::optional<CrossDisc> disc = disc_of(scene, kLifted);
  if (!disc) {
    return;
  }
  if (shown_at < seen_ || shown_at - kForgetPlacesAfter > seen_) {
    history_ = {};
  }
  seen_ = shown_at;
  find_parts(scene, eyes, *disc);
  settle(scene, eyes, shown_at);
  if (const std::size_t place = *history_.place; place > 0) {
    turn_block(scene, {eyes.head(), middle_, angle_of(place)});
  }
}

void CrossLift::find_parts(const render::Scene& scene, const Eyes& eyes, const CrossDisc& disc) {
  parts_.clear();
  rows_.clear();
  middle_ = disc.middle;
  parts_.push_back({disc.middle, disc.radius_m, 0, {-1, -1, 1, 1}});
  for (const TextItem& text : scene.texts) {
    LabelExtent extent;
    extent.width = render::line_width(font_, text);
    const CapsBox box = box_at(place_of(text, extent, 0), extent);
    if (text.place == render::TextPlace::kView) {
      rows_.push_back(eyes.box(render::world_from_caps(text, eyes.head()), box));
    } else if (of_block(text)) {
      parts_.push_back({text.position, text.height_m, text.min_height_deg, box});
    }
  }
}

LabelVerdict CrossLift::judge(std::size_t place, const Eyes& eyes, float margin) const {
  const TurnUp turn(eyes.head(), middle_, angle_of(place));
  LabelVerdict verdict;
  int named = 0;
  TextItem text;
  for (const Part& part : parts_) {
    text.position = turn.place(part.position);
    text.height_m = part.height_m;
    text.min_height_deg = part.min_height_deg;
    const auto box = grown(eyes.box(render::world_from_caps(text, eyes.head()), part.box), margin);
    verdict.blocked += static_cast<int>(std::count_if(
        rows_.begin(), rows_.end(), [&](const BoxInEyes& row) { return overlap(row, box); }));
    named += static_cast<int>(
        std::count_if(obstacles_.begin(), obstacles_.end(), [&](const LabelObstacle& obstacle) {
          return obstacle.kind == LabelObstacle::Kind::kNamed && !of_block(obstacle.label) &&
                 overlap(obstacle.seen, box);
        }));
  }
  // Where it was built it may stand whatever it covers.
  verdict.cost =
      kOverRow * verdict.blocked + (place > 0 ? kOverPlace * named : 0) + static_cast<int>(place);
  return verdict;
}

CrossLift::Best CrossLift::best_of(const Eyes& eyes, std::optional<std::size_t> without) const {
  std::optional<Best> best;
  for (std::size_t place = 0; place < kPlaces; ++place) {
    // Later places cost more even when they are free.
    if (place == without || (best && best->verdict.cost <= static_cast<int>(place))) {
      continue;
    }
    const LabelVerdict verdict = judge(place, eyes, kRoomToCome);
    if (!best || verdict.cost < best->verdict.cost) {
      best = Best{place, verdict};
    }
  }
  return *best;
}

void CrossLift::settle(const render::Scene& scene, const Eyes& eyes, Timestamp now) {
  obstacles_.clear();
  const bool is_new = !history_.place;
  if (history_.place.value_or(0) == 0 && judge(0, eyes, kRoomToStay).blocked == 0) {
    history_.place = 0;
    history_.better.reset();
    return;
  }
  find_obstacles(scene, {}, eyes, obstacles_);
  Best best = best_of(eyes, std::nullopt);
  if (is_new) {
    history_.place = best.place;
    return;
  }
  const LabelVerdict here = judge(*history_.place, eyes, kRoomToStay);
  if (here.blocked > best.verdict.blocked) {
    if (history_.just_left(best.place, now)) {
      const Best other = best_of(eyes, best.place);
      best = other.verdict.blocked == 0 ? other : best;
    }
    history_.move(best.place, now);
  } else if (best.verdict.cost < here.cost) {
    history_.wait_for(best.place, now);
  } else {
    history_.better.reset();
  }
}

}  // namespace orthonav::engine
