#include "hal/sim/cameras/room_renderer_solids.h"

#include <algorithm>
#include <cmath>

#include "hal/sim/room/tag_flaws.h"

namespace orthonav::sim {
namespace {

/// The white margin extends beyond the quiet zone by this fraction of a cell.
constexpr double kMarginCells = 0.25;
constexpr Tint kSteel{0.93F, 0.97F, 1.0F};
constexpr Tint kHandleTint{0.75F, 0.85F, 1.0F};
constexpr Tint kGlove{0.93F, 0.96F, 1.0F};
constexpr Tint kBlood{0.55F, 0.10F, 0.08F};
constexpr float kBloodAlbedo = 0.10F;
constexpr Tint kGown{0.42F, 0.78F, 0.80F};
/// Nothing nearer to the camera than this is drawn.
constexpr double kNearM = 0.06;
/// Rank of bodies on the face of a plate.
constexpr int kOnTheFace = 2;

Capsule rod(Vec3 a, Vec3 b, double radius_a, double radius_b, float albedo, float gloss,
            Tint tint) {
  return {a, b, radius_a, radius_b, albedo, gloss, tint, 0};
}

/// Shaft from the tip, handle, and a bracket that holds the plate from behind.
std::vector<Capsule> rods_of(const RoomTool& tool, double half_m) {
  std::vector<Capsule> rods;
  const Vec3 tip = tool.tip_in_marker.v;
  const double length = tool.axis_in_marker.norm();
  if (!(length > 0.0)) {
    return rods;
  }
  const Vec3 axis = tool.axis_in_marker / length;
  const double reach = -tip.dot(axis);  // along the axis to the point nearest the tag's centre
  const Vec3 foot = tip + reach * axis;
  const double aside = foot.norm();
  // The rod ends at the plate's rim where it would cross the plate.
  const double rim = aside < half_m ? std::sqrt(half_m * half_m - aside * aside) : -0.02;
  const double end = reach - rim;
  if (!(end > 0.012)) {
    return rods;
  }
  const double shaft = tool.kind == ToolKind::kGuide ? 0.0045 : 0.0018;
  const double handle = tool.kind == ToolKind::kReference ? 0.004 : 0.0075;
  const double grip = 0.45 * end;
  const auto at = [&](double s) { return tip + s * axis; };
  const double point = tool.kind == ToolKind::kGuide ? 0.6 * shaft : 0.0004;
  rods.push_back(rod(at(0.0), at(0.008), point, shaft, 0.5F, 0.5F, kSteel));
  rods.push_back(rod(at(0.008), at(grip + 0.004), shaft, shaft, 0.5F, 0.5F, kSteel));
  if (tool.kind == ToolKind::kReference) {
    rods.push_back(rod(at(grip), at(end), handle, handle, 0.45F, 0.4F, kSteel));
  } else {
    rods.push_back(rod(at(grip), at(end), handle, 0.85 * handle, 0.2F, 0.2F, kHandleTint));
  }
  const Vec3 behind{0.0, 0.0, -0.006};
  rods.push_back(rod(at(end), behind, 0.004, 0.004, 0.35F, 0.3F, kSteel));
  return rods;
}

/// Discs on the face of the plate; nothing of them shows from behind it.
void add_drops(const TagFlaws& flaws, std::vector<Capsule>& bodies) {
  for (const TagDrop& drop : flaws.drops) {
    const Vec3 at{drop.place_m.x, drop.place_m.y, 0.0};
    Capsule disc = rod(at, at, drop.radius_m, drop.radius_m, kBloodAlbedo, 0.3F, kBlood);
    disc.rank = kOnTheFace;
    bodies.push_back(disc);
  }
}

float lit(Vec3 normal_in_room) {
  const double cosine = std::max(0.0, normal_in_room.dot(lamp_in_room()));
  return static_cast<float>(0.90 + 0.12 * cosine);
}

/// Cuts off the part nearer than kNearM; false if nothing is left.
bool clip_near(Capsule& c) {
  if (!c.a.is_finite() || !c.b.is_finite()) {
    return false;
  }
  if (c.a.z < kNearM && c.b.z < kNearM) {
    return false;
  }
  if (c.a.z >= kNearM && c.b.z >= kNearM) {
    return true;
  }
  const double s = (kNearM - c.a.z) / (c.b.z - c.a.z);
  const Vec3 cut = c.a + s * (c.b - c.a);
  const double radius = c.radius_a_m + s * (c.radius_b_m - c.radius_a_m);
  (c.a.z < kNearM ? c.a : c.b) = cut;
  (c.a.z < kNearM ? c.radius_a_m : c.radius_b_m) = radius;
  c.a.z = std::max(c.a.z, kNearM);
  c.b.z = std::max(c.b.z, kNearM);
  return true;
}

void add_hand(const RoomState& state, const Transform<LeftCamera, Room>& camera_from_room,
              std::vector<Capsule>& capsules) {
  const Vec3 centre = state.hand->v;
  const double length = state.hand_axis.norm();
  const Vec3 back = length > 0.0 ? state.hand_axis / length : Vec3{0, 1, 0};
  const Vec3 hint = std::abs(back.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  const Vec3 side = back.cross(hint).normalized();
  const Vec3 up = side.cross(back);
  const auto add = [&](Vec3 a, Vec3 b, double ra, double rb, float albedo, Tint tint) {
    Capsule c{(camera_from_room * Point<Room>{a}).v,
              (camera_from_room * Point<Room>{b}).v,
              ra,
              rb,
              albedo,
              0.1F,
              tint,
              -1};
    if (clip_near(c)) {
      capsules.push_back(c);
    }
  };
  // A fist round the handle: back of the hand, four fingers in two bones each, the thumb; then the
  // wrist and the sleeve of the gown over the glove.
  add(centre + 0.022 * back + 0.010 * up, centre + 0.062 * back, 0.026, 0.027, 0.55F, kGlove);
  for (int i = 0; i < 4; ++i) {
    const double spread = 0.027 - 0.018 * i;
    const double reach = i == 0 || i == 3 ? 0.024 : 0.029;
    const Vec3 knuckle = centre + spread * side + 0.020 * up + 0.016 * back;
    const Vec3 joint = knuckle - reach * back - 0.004 * up;
    add(knuckle, joint, 0.0105, 0.0095, 0.60F, kGlove);
    add(joint, joint - 0.020 * up + 0.006 * back, 0.0095, 0.0085, 0.57F, kGlove);
  }
  const Vec3 thumb = centre + 0.033 * side - 0.004 * up;
  add(thumb + 0.034 * back, thumb + 0.004 * back, 0.013, 0.0115, 0.57F, kGlove);
  add(thumb + 0.004 * back, thumb - 0.022 * back - 0.012 * side, 0.0115, 0.0095, 0.60F, kGlove);
  add(centre + 0.062 * back, centre + 0.110 * back, 0.027, 0.031, 0.53F, kGlove);
  add(centre + 0.105 * back, centre + 0.112 * back, 0.0345, 0.035, 0.30F, kGown);
  add(centre + 0.118 * back, centre + 0.310 * back, 0.036, 0.046, 0.36F, kGown);
}

}  // namespace

ToolBodies::ToolBodies(const RoomDescription& room) {
  for (std::size_t i = 0; i < room.tools.size(); ++i) {
    const RoomTool& tool = room.tools[i];
    Body body;
    body.size_m = tool.size_m;
    body.flaws = i < room.tag_flaws.size() ? room.tag_flaws[i] : TagFlaws{};
    body.pattern = tag_pattern(tool.family, tool.id);
    const int border = body.pattern ? body.pattern->border_cells : 8;
    const int cells = body.pattern ? body.pattern->cells : 10;
    body.cell_m = tool.size_m / border;
    body.half_m = (0.5 * std::max(cells, border + 2) + kMarginCells) * body.cell_m;
    body.rods = rods_of(tool, body.half_m);
    add_drops(body.flaws, body.rods);
    bodies_.push_back(std::move(body));
  }
  for (const StandingScrew& screw : room.screws) {
    const auto level =
        std::find_if(room.levels.begin(), room.levels.end(),
                     [&screw](const RoomLevel& other) { return other.label == screw.level; });
    constexpr double kNeck_m = 0.0028;
    constexpr double kHead_m = 0.0055;
    const Vec3 top = screw.head().v;
    const Vec3 inside = top + kHead_m * screw.direction;
    Capsule ball = rod(inside, inside, kHead_m, kHead_m, 0.55F, 0.6F, kSteel);
    ball.rank = 1;  // over its neck
    heads_.push_back({static_cast<std::size_t>(level - room.levels.begin()),
                      {rod(screw.entry.v, inside, kNeck_m, kNeck_m, 0.5F, 0.5F, kSteel), ball}});
  }
}

void ToolBodies::gather(const RoomState& state, const Transform<LeftCamera, Room>& camera_from_room,
                        Solids& solids, double gloss) const {
  solids.plates.clear();
  solids.capsules.clear();
  solids.lamp_in_camera = (camera_from_room * Direction<Room>{lamp_in_room()}).v;
  const Vec3 viewer = camera_from_room.inverse().translation();
  const std::size_t known =
      std::min({bodies_.size(), state.room_from_marker.size(), state.tool_present.size()});
  for (std::size_t i = 0; i < known; ++i) {
    if (state.tool_present[i]) {
      add_tool(i, state.room_from_marker[i], camera_from_room, viewer, gloss, solids);
    }
  }
  for (const Head& head : heads_) {
    if (head.level >= state.room_from_vertebra.size()) {
      continue;
    }
    const auto camera_from_vertebra = camera_from_room * state.room_from_vertebra[head.level];
    for (Capsule part : head.parts) {
      part.a = (camera_from_vertebra * Point<Vertebra>{part.a}).v;
      part.b = (camera_from_vertebra * Point<Vertebra>{part.b}).v;
      part.tool = static_cast<int>(bodies_.size());
      if (clip_near(part)) {
        solids.capsules.push_back(part);
      }
    }
  }
  if (state.hand) {
    add_hand(state, camera_from_room, solids.capsules);
  }
}

void ToolBodies::add_tool(std::size_t tool, const Transform<Room, Marker>& room_from_marker,
                          const Transform<LeftCamera, Room>& camera_from_room, Vec3 viewer,
                          double gloss, Solids& solids) const {
  const Body& body = bodies_[tool];
  const auto camera_from_marker = camera_from_room * room_from_marker;
  const Vec3 at = camera_from_marker.translation();
  if (!at.is_finite()) {
    return;
  }
  const Vec3 normal = room_from_marker.rotation().column(2);
  const Vec3 to_viewer = (viewer - room_from_marker.translation()).normalized();
  if (at.z - 1.5 * body.half_m > kNearM && body.half_m > 0.0) {
    solids.plates.push_back({camera_from_marker, body.pattern ? &*body.pattern : nullptr,
                             body.cell_m, body.half_m, lit(normal), static_cast<int>(tool),
                             static_cast<float>(glare(gloss, normal, lamp_in_room(), to_viewer)),
                             &body.flaws, body.size_m});
  }
  for (const Capsule& in_marker : body.rods) {
    if (in_marker.rank >= kOnTheFace && !(normal.dot(to_viewer) > 0.0)) {
      continue;
    }
    Capsule c = in_marker;
    c.tool = static_cast<int>(tool);
    c.a = (camera_from_marker * Point<Marker>{c.a}).v;
    c.b = (camera_from_marker * Point<Marker>{c.b}).v;
    if (clip_near(c)) {
      solids.capsules.push_back(c);
    }
  }
}

}  // namespace orthonav::sim
