#include "engine/holograms/labels/block_place.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/holograms/labels/label_places.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/hologram_parts.h"
#include "render/float3.h"
#include "render/frame/frame_items.h"

namespace orthonav::engine {
namespace {

using render::Float3;
using render::TextItem;

constexpr render::Label kPlacedCross = label_of(HologramKind::kCross, 1);
constexpr render::Label kPlacedDepth = label_of(HologramKind::kDepth, 1);
constexpr render::Label kPlacedOffset = label_of(HologramKind::kNumbers, 6);
constexpr render::Label kWayToEntry = label_of(HologramKind::kTrajectory, 3);
// The status line and the edges of the view go with every move of the head, the world does not: a
// block needs more room than labels that stand in the world need from each other. Tangents of
// angles.
constexpr float kRoomToStay = 0.0010f;
constexpr float kRoomToCome = 0.0105f;  // 0.6 degrees
/// To the edge of a view, at least: a digit's width, and a little for texts that face the eyes
/// anew.
constexpr float kEdge = 0.009f;
// What a place costs for what it covers: each is worse than all of the next together, and than any
// number of steps.
constexpr int kCostCut = 1 << 20;
constexpr int kCostRow = 1 << 19;
constexpr int kCostWound = 1 << 18;
constexpr int kCostLine = 1 << 17;
constexpr int kCostTool = 1 << 16;
constexpr int kCostPaper = 1 << 15;
constexpr int kCostNamed = 1 << 14;

/// A step up or down of the status line counts like so many aside, squared: the wound is above it.
constexpr int kStatusUp = 16;

constexpr std::size_t kColumns = 2 * BlockPlace::kAside + 1;
constexpr std::size_t kPlaces = kColumns * (2 * BlockPlace::kUp + 1);

// The arrow: inside the edge of what eyes 72 mm apart see at its distance, above the status line.
constexpr float kArrowInside = 0.10f;
constexpr float kAboveStatus = 0.07f;
constexpr float kArrowDistance_m = 0.5f;
constexpr float kArrowLength_m = 0.012f;

bool of_cross(render::Label label) {
  const HologramKind kind = kind_of(label);
  return kind == HologramKind::kCross || kind == HologramKind::kAngle ||
         kind == HologramKind::kNumbers || label == kPlacedDepth;
}

bool is_row(const TextItem& text) { return text.place == render::TextPlace::kView; }

bool of_cross(const TextItem& text) { return !is_row(text) && of_cross(text.label); }

/// Written only where it was asked for.
bool on_request(const TextItem& text) {
  return of_cross(text) && kind_of(text.label) == HologramKind::kNumbers &&
         text.label < kPlacedOffset - 2;
}

/// Steps to the right and up; place 0 is the one it was built at.
std::array<int, 2> steps_of(std::size_t place) {
  // Numbered by rows from the middle one on, so that 0 is no step: 0, 1, -1, 2, -2, ...
  const auto zigzag = [](std::size_t i) {
    const int half = static_cast<int>((i + 1) / 2);
    return i % 2 == 1 ? half : -half;
  };
  return {zigzag(place % kColumns), zigzag(place / kColumns)};
}

/// Turns what is in the world about the eyes, so that this place goes to the right and up as they
/// see it.
class Turn {
 public:
  Turn(const render::Head& head, Float3 place, std::array<int, 2> steps)
      : eyes_(head.position),
        towards_(render::unit_or(head.position - place, head.back)),
        right_(render::unit_or(render::cross(head.up, towards_), head.right)),
        up_(render::cross(towards_, right_)) {
    const float yaw = BlockPlace::kStep_rad * static_cast<float>(steps[0]);
    const float nod = BlockPlace::kStep_rad * static_cast<float>(steps[1]);
    const float c = std::cos(yaw), s = std::sin(yaw), d = std::cos(nod), t = std::sin(nod);
    // Where right, up and towards go: first up, then aside.
    new_up_ = d * up_ + t * (c * towards_ - s * right_);
    new_towards_ = d * (c * towards_ - s * right_) - t * up_;
    new_right_ = c * right_ + s * towards_;
  }

  [[nodiscard]] Float3 place(Float3 p) const { return eyes_ + direction(p - eyes_); }
  [[nodiscard]] Float3 direction(Float3 v) const {
    return dot(v, right_) * new_right_ + dot(v, up_) * new_up_ + dot(v, towards_) * new_towards_;
  }
  void turn(render::Matrix4& m) const {
    for (int axis = 0; axis < 3; ++axis) {
      m[axis] = render::Float4(direction(Float3(m[axis])), 0);
    }
    m[3] = render::Float4(place(Float3(m[3])), 1);
  }

 private:
  Float3 eyes_{};
  Float3 towards_{};
  Float3 right_{};
  Float3 up_{};
  Float3 new_right_{};
  Float3 new_up_{};
  Float3 new_towards_{};
};

void turn_cross(render::Scene& scene, const Turn& turn) {
  for (render::MeshItem& mesh : scene.meshes) {
    if (of_cross(mesh.label)) {
      turn.turn(mesh.world_from_model);
    }
  }
  for (render::LineItem& line : scene.lines) {
    if (of_cross(line.label)) {
      std::transform(line.points.begin(), line.points.end(), line.points.begin(),
                     [&](Float3 p) { return turn.place(p); });
    }
  }
  for (render::TriangleItem& triangle : scene.triangles) {
    if (of_cross(triangle.label)) {
      for (Float3& corner : triangle.corners) {
        corner = turn.place(corner);
      }
    }
  }
  for (TextItem& text : scene.texts) {
    if (of_cross(text)) {
      text.position = turn.place(text.position);
    }
  }
}

/// The rows of the status line, in the frame of the head.
void turn_rows(render::Scene& scene, std::array<int, 2> steps) {
  for (TextItem& text : scene.texts) {
    if (is_row(text)) {
      text.position = Turn(render::Head{}, text.position, steps).place(text.position);
    }
  }
}

int cost_of(const LabelObstacle& obstacle, PlacedBlock block) {
  switch (obstacle.kind) {
    case LabelObstacle::Kind::kWound:
      return kCostWound;
    case LabelObstacle::Kind::kLine:
      return kind_of(obstacle.label) == HologramKind::kTriangle ? kCostTool : kCostLine;
    case LabelObstacle::Kind::kGlare:
      return kCostPaper;
    case LabelObstacle::Kind::kNamed:
      return block == PlacedBlock::kCross && of_cross(obstacle.label) ? 0 : kCostNamed;
    case LabelObstacle::Kind::kLeader:
      break;
  }
  return 0;
}

/// The end of the planned trajectory on the bone; absent: none is shown.
std::optional<Float3> entry_of(const render::Scene& scene) {
  for (const render::LineItem& line : scene.lines) {
    if (line.label == label_of(HologramKind::kTrajectory, 1) && line.dash_m == 0) {
      return line.points.back();
    }
  }
  return std::nullopt;
}

}  // namespace

void BlockPlace::lay_out(render::Scene& scene, const Eyes& eyes,
                         std::span<const GlarePatch> patches, Timestamp shown_at) {
  if (!find_middle(scene, eyes)) {
    return;
  }
  if (shown_at < seen_ || shown_at - kForgetPlacesAfter > seen_) {
    history_ = {};
  }
  seen_ = shown_at;
  // As texts there face the eyes.
  const Float3 towards = render::unit_or(eyes.head().position - middle_, eyes.head().back);
  right_ = render::unit_or(render::cross(eyes.head().up, towards), eyes.head().right);
  up_ = render::cross(towards, right_);
  find_obstacles(scene, patches, eyes, obstacles_);
  if (block_ == PlacedBlock::kStatus) {
    add_wound(scene, eyes, obstacles_);
  }
  find_rows(scene, eyes);
  extent_ = extent_of(scene, eyes);
  settle(eyes, shown_at);
  if (block_ == PlacedBlock::kStatus) {
    if (const std::size_t place = *history_.place; place > 0) {
      turn_rows(scene, steps_of(place));
    }
    return;
  }
  if (cost_of(*history_.place, eyes, 0) >= kCostCut) {
    scene.texts.erase_if(on_request);
    extent_ = extent_of(scene, eyes);
    settle(eyes, shown_at);
  }
  if (cost_of(*history_.place, eyes, 0) >= kCostCut) {
    const auto gone = [](const auto& item) { return of_cross(item.label); };
    scene.meshes.erase_if(gone);
    scene.lines.erase_if(gone);
    scene.triangles.erase_if(gone);
    scene.texts.erase_if([](const TextItem& item) { return of_cross(item); });
    return;
  }
  if (const std::size_t place = *history_.place; place > 0) {
    turn_cross(scene, {eyes.head(), middle_, steps_of(place)});
  }
}

/// Where the block was built, metres in the world; false: the scene has none.
bool BlockPlace::find_middle(const render::Scene& scene, const Eyes& eyes) {
  if (block_ == PlacedBlock::kCross) {
    const std::optional<CrossDisc> disc = disc_of(scene, kPlacedCross);
    middle_ = disc ? disc->middle : middle_;
    radius_m_ = disc ? disc->radius_m : 0;
    return disc.has_value();
  }
  const auto* row = std::find_if(scene.texts.begin(), scene.texts.end(), is_row);
  if (row == scene.texts.end()) {
    return false;
  }
  const render::Head& head = eyes.head();
  const Float3 at = row->position;
  middle_ = head.position + at.x * head.right + at.y * head.up + at.z * head.back;
  return true;
}

/// The rows of the status line, which the cross makes way for.
void BlockPlace::find_rows(const render::Scene& scene, const Eyes& eyes) {
  rows_.clear();
  for (const TextItem& text : scene.texts) {
    if (block_ == PlacedBlock::kCross && is_row(text)) {
      LabelExtent extent;
      extent.width = render::line_width(font_, text);
      rows_.push_back(eyes.box(render::world_from_caps(text, eyes.head()),
                               box_at(place_of(text, extent, 0), extent)));
    }
  }
}

BlockPlace::Extent BlockPlace::extent_of(const render::Scene& scene, const Eyes& eyes) const {
  const render::Head& head = eyes.head();
  Extent extent{-radius_m_, -radius_m_, radius_m_, radius_m_};
  const auto take_in = [&](Float3 p) {
    const Float3 from = p - middle_;
    const float right = dot(from, right_);
    const float up = dot(from, up_);
    extent = {std::min(extent.left, right), std::min(extent.bottom, up),
              std::max(extent.right, right), std::max(extent.top, up)};
  };
  for (const render::LineItem& line : scene.lines) {
    if (block_ == PlacedBlock::kCross && of_cross(line.label)) {
      std::for_each(line.points.begin(), line.points.end(), take_in);
    }
  }
  for (const TextItem& text : scene.texts) {
    if (block_ == PlacedBlock::kCross ? !of_cross(text) : !is_row(text)) {
      continue;
    }
    LabelExtent of_text;
    of_text.width = render::line_width(font_, text);
    const CapsBox box = box_at(place_of(text, of_text, 0), of_text);
    const render::Matrix4 m = render::world_from_caps(text, head);
    take_in(render::transformed(m, {box.left, box.bottom, 0}));
    take_in(render::transformed(m, {box.right, box.top, 0}));
  }
  return extent;
}

int BlockPlace::cost_of(std::size_t place, const Eyes& eyes, float margin) const {
  const auto steps = steps_of(place);
  const render::Head& head = eyes.head();
  const Turn turn(head, middle_, steps);
  const Float3 middle = turn.place(middle_);
  const Float3 right = turn.direction(right_);
  const Float3 up = turn.direction(up_);
  const std::array<Float3, 4> corners = {middle + extent_.left * right + extent_.bottom * up,
                                         middle + extent_.right * right + extent_.bottom * up,
                                         middle + extent_.right * right + extent_.top * up,
                                         middle + extent_.left * right + extent_.top * up};
  const BoxInEyes ink = eyes.box(corners);
  const BoxInEyes box = grown(ink, margin);
  int covered = eyes.in_view(grown(ink, margin + kEdge)) ? 0 : kCostCut;
  for (const BoxInEyes& row : rows_) {
    covered |= overlap(row, box) ? kCostRow : 0;
  }
  for (const LabelObstacle& obstacle : obstacles_) {
    const int cost = engine::cost_of(obstacle, block_);
    if ((covered & cost) == 0 && cost > 0 && overlap(obstacle.seen, box)) {
      covered |= cost;
    }
  }
  const int up_costs = block_ == PlacedBlock::kStatus ? kStatusUp : 1;
  return covered + steps[0] * steps[0] + up_costs * steps[1] * steps[1];
}

BlockPlace::Best BlockPlace::best_of(const Eyes& eyes, std::optional<std::size_t> without) const {
  Best best{0, 2 * kCostCut};
  for (std::size_t place = 0; place < kPlaces; ++place) {
    const auto steps = steps_of(place);
    if (place == without || steps[0] * steps[0] + steps[1] * steps[1] >= best.cost) {
      continue;
    }
    const int cost = cost_of(place, eyes, kRoomToCome);
    best = cost < best.cost ? Best{place, cost} : best;
  }
  return best;
}

void BlockPlace::settle(const Eyes& eyes, Timestamp now) {
  const auto covered = [](int cost) { return cost / kCostNamed; };
  const bool is_new = !history_.place;
  if (history_.place.value_or(0) == 0 && covered(cost_of(0, eyes, kRoomToStay)) == 0) {
    history_.place = 0;
    history_.better.reset();
    return;
  }
  Best best = best_of(eyes, std::nullopt);
  if (is_new) {
    history_.place = best.place;
    return;
  }
  const int here = cost_of(*history_.place, eyes, kRoomToStay);
  if (covered(here) > covered(best.cost)) {
    if (history_.just_left(best.place, now)) {
      const Best other = best_of(eyes, best.place);
      best = covered(other.cost) < covered(here) ? other : best;
    }
    history_.move(best.place, now);
  } else if (best.cost < here) {
    history_.wait_for(best.place, now);
  } else {
    history_.better.reset();
  }
}

void point_to_entry(render::Scene& scene, const Eyes& eyes) {
  const std::optional<Float3> entry = entry_of(scene);
  if (!entry || eyes.in_view(*entry)) {
    return;
  }
  const render::Head& head = eyes.head();
  const Float3 to = *entry - head.position;
  const float right = dot(to, head.right);
  const float up = dot(to, head.up);
  const float away = std::hypot(right, up);
  const float across = away > 0 ? right / away : 0;
  const float upwards = away > 0 ? up / away : 1;
  // Where a line from the middle of what both eyes see meets its edge.
  const SeenBox field = grown(eyes.common_field(), -kArrowInside);
  const float low = field.bottom + kAboveStatus;
  const float reach = std::min(across > 0   ? field.right / across
                               : across < 0 ? field.left / across
                                            : 1.0f,
                               upwards > 0   ? field.top / upwards
                               : upwards < 0 ? low / upwards
                                             : 1.0f);
  const Float3 along = across * head.right + upwards * head.up;
  const Float3 aside = upwards * head.right - across * head.up;
  const Float3 tip = head.position + kArrowDistance_m * (reach * along - head.back);
  const Float3 foot = tip - kArrowLength_m * along;
  scene.triangles.push_back(
      {kWayToEntry,
       {tip, foot + 0.6f * kArrowLength_m * aside, foot - 0.6f * kArrowLength_m * aside},
       look::colours().entry});
}

}  // namespace orthonav::engine
