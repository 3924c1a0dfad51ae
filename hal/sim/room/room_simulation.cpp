#include "hal/sim/room/room_simulation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orthonav::sim {
namespace {

/// Physiological tremor of a hand holding a tool: 8-12 Hz (Elble and Koller 1990).
constexpr double kSlowestTremor_hz = 8.0;
constexpr double kFastestTremor_hz = 12.0;
/// The map's origin is where the headset was switched on: anywhere, in any heading, but level.
const Transform<World, Room> kMapAtStart{rotation_from_vector({0.0, 0.7, 0.0}), {0.4, -1.1, 0.6}};

}  // namespace

RoomSimulation::RoomSimulation(RoomDescription room, const SimOptions& options, Vec3 eyes_in_rig,
                               Timestamp start)
    : room_(std::move(room)),
      error_model_(options.error_model),
      layout_(room_),
      start_(start),
      physics_(Random(options.seed).fork("physics")),
      head_(Random(options.seed).fork("head"), error_model_, eyes_in_rig, {layout_.middle()}),
      drift_(Random(options.seed).fork("map"), error_model_.map_drift_m_per_sqrt_s,
             error_model_.map_drift_rad_per_sqrt_s, options.limit_s,
             {error_model_.map_step_m, error_model_.map_steps_per_min}),
      tremor_m_(Random(options.seed).fork("tremor position"), error_model_.tremor_m,
                kSlowestTremor_hz, kFastestTremor_hz),
      tremor_rad_(Random(options.seed).fork("tremor rotation"), error_model_.tremor_rad,
                  kSlowestTremor_hz, kFastestTremor_hz),
      spine_(Random(options.seed).fork("spine"), error_model_),
      relies_on_reference_(options.relies_on_reference),
      bump_(options.reference_bump),
      bumping_(Random(options.seed).fork("bump")),
      shift_(options.patient_shift),
      shifting_(Random(options.seed).fork("shift")) {
  RoomState nothing;
  nothing.room_from_marker.resize(room_.tools.size());
  nothing.tool_present.resize(room_.tools.size());
  nothing.room_from_vertebra.resize(layout_.levels());
  level_moved_m_.resize(layout_.levels());
  for (const RoomLevel& level : room_.levels) {
    breath_fractions_.push_back(fraction_of_breath(level.label));
  }
  for (const StandingScrew& screw : room_.screws) {
    truth_.heads.push_back({screw.level, screw.side,
                            layout_.room_from_vertebra(*layout_.find(screw.level)) * screw.head()});
  }
  states_.resize(kKept, nothing);
  if (options.surgeon && layout_.levels() > 0) {
    surgeon_ =
        options.surgeon({layout_, error_model_, Random(options.seed).fork("surgeon"),
                         RetainedImplants(truth_), options.guidance, options.relies_on_reference});
  }
  step();
}

void RoomSimulation::advance(Timestamp until) {
  while (kept(steps_ - 1).time < until) {
    step();
  }
}

void RoomSimulation::step() {
  RoomState& now = kept(steps_);
  now.time = start_ + static_cast<std::int64_t>(steps_) * kStep;
  shift_patient();
  move_patient(now);
  if (surgeon_) {
    head_.advance(seconds(kStep), surgeon_->body().posture().head);
  }
  now.room_from_rig = head_.pose(seconds_in(now.time));
  ++steps_;
  light_up(now.time);
  std::fill(now.tool_present.begin(), now.tool_present.end(), false);
  now.hand.reset();
  if (surgeon_) {
    let_surgeon_act(now);
  } else {
    let_tools_hover(now);
  }
  if (layout_.levels() > 0) {
    leave_reference(now);
  }
}

void RoomSimulation::show(const WornFrame& frame,
                          const Transform<World, Rig>& believed_world_from_rig) {
  if (frame.display_time <= newest_drawn_) {
    return;
  }
  newest_drawn_ = frame.display_time;
  if (drawn_count_ == kMostDrawn) {
    first_drawn_ = (first_drawn_ + 1) % kMostDrawn;
    --drawn_count_;
  }
  drawn_[(first_drawn_ + drawn_count_) % kMostDrawn] = {frame, believed_world_from_rig};
  ++drawn_count_;
}

void RoomSimulation::light_up(Timestamp until) {
  while (drawn_count_ > 0 && drawn_[first_drawn_].frame.display_time <= until) {
    const Drawn& due = drawn_[first_drawn_];
    if (surgeon_) {
      surgeon_->see(due.frame,
                    room_from_rig(due.frame.display_time) * due.believed_world_from_rig.inverse());
    }
    first_drawn_ = (first_drawn_ + 1) % kMostDrawn;
    --drawn_count_;
  }
}

/// A breath moves each level by its share. A level pushed by an instrument takes its neighbours
/// along, by less with each level.
void RoomSimulation::move_patient(RoomState& now) {
  const Vec3 breath_m = spine_.at(seconds_in(now.time));
  back_moved_m_ = breath_m + slipped_m_;
  for (std::size_t i = 0; i < layout_.levels(); ++i) {
    level_moved_m_[i] = breath_fractions_[i] * breath_m + slipped_m_;
    const auto& at_rest = layout_.room_from_vertebra(i);
    now.room_from_vertebra[i] = {at_rest.rotation(),
                                 at_rest.translation() + level_moved_m_[i] + pushed_m(i)};
  }
  // The drawn spine moves with the first operated level.
  const Vec3 drawn_m =
      layout_.operated().empty() ? back_moved_m_ : level_moved_m_[layout_.operated().front()];
  now.room_from_spine = {layout_.room_from_spine().rotation(),
                         layout_.room_from_spine().translation() + drawn_m};
}

Vec3 RoomSimulation::pushed_m(std::size_t level) const {
  return surgeon_ ? pushed_m_by(std::abs(layout_.rank(level) - rank_at_hand())) : Vec3{};
}

int RoomSimulation::rank_at_hand() const { return layout_.rank(surgeon_->body().posture().level); }

Vec3 RoomSimulation::pushed_m_by(int levels_away) const {
  return std::pow(error_model_.push_reaching_reference, levels_away) *
         surgeon_->body().posture().pushed_m;
}

void RoomSimulation::let_surgeon_act(RoomState& now) {
  surgeon_->tick(now.time, {now.room_from_rig.origin(), level_moved_m_});
  SurgeonBody& body = surgeon_->body();
  const Posture& posture = body.posture();
  const auto tool = posture.in_hand ? layout_.tool(*posture.in_hand) : std::nullopt;
  if (tool) {
    // The hand rests on the patient and moves with them.
    put(now, *tool, on_patient(posture), posture.contact_normal, posture.on_wire);
    const Vec3 view = posture.head.from_gaze;
    // The forearm comes from the surgeon's right, across the shaft, so that it never hides the tag,
    // and below the line of sight to the wound.
    const Vec3 across = posture.grip.axis.cross(view).normalized();
    now.hand = hand_on(room_.tools[*tool], posture.grip);
    now.hand_axis = (0.9 * across + 0.35 * Vec3{view.x, 0.0, view.z}).normalized();
  }
  drive_wire();
  clicks_.insert(clicks_.end(), body.clicks.begin(), body.clicks.end());
  phrases_.insert(phrases_.end(), body.phrases.begin(), body.phrases.end());
  body.clicks.clear();
  body.phrases.clear();
  if (surgeon_->finished() && !finished_at_) {
    finished_at_ = now.time;
  }
  truth_.surgeon_gave_up = surgeon_->gave_up();
}

/// The reference is clamped to the patient, facing the head's initial position, and moves with
/// them. If it is used, its arm reaches to the surgeon's side of the wound: there no tool comes
/// between it and the cameras, since a tag that is held above the wound hides what lies beyond.
void RoomSimulation::leave_reference(RoomState& now) {
  constexpr Vec3 kOnTheSurgeonsSide_m{0.12, 0.0, -0.08};
  constexpr Vec3 kBeyondTheWound_m{-0.02, 0.0, 0.13};
  const auto reference = layout_.tool(ToolKind::kReference);
  if (!reference) {
    return;
  }
  if (!room_from_reference_) {
    const Vec3 beside_m = relies_on_reference_ ? kOnTheSurgeonsSide_m : kBeyondTheWound_m;
    put(now, *reference, {layout_.middle() + beside_m, {0, 1, 0}, 0.0}, std::nullopt);
    room_from_reference_ = now.room_from_marker[*reference];
    if (surgeon_ && relies_on_reference_) {
      surgeon_->see_reference(room_from_reference_->rotation() * Vec3{0.0, 0.0, 1.0});
    }
  }
  const bool is_due = wires_driven_ >= bump_.after_wires;
  if (is_due && (bump_.translation_m > 0.0 || bump_.rotation_rad > 0.0)) {
    bump_reference();
  }
  // On the vertebra above the first operated one.
  const std::size_t below = layout_.operated().empty() ? 0 : layout_.operated().front();
  const int rank = layout_.rank(below) - 1;
  const Vec3 moved_m = level_moved_m_[layout_.of_rank(rank).value_or(below)] +
                       (surgeon_ ? pushed_m_by(std::abs(rank - rank_at_hand())) : Vec3{});
  now.room_from_marker[*reference] = {room_from_reference_->rotation(),
                                      room_from_reference_->translation() + moved_m};
  now.tool_present[*reference] = true;
}

void RoomSimulation::bump_reference() {
  const Vec3 way = normal_vector(bumping_, 1.0).normalized();
  const Vec3 about = normal_vector(bumping_, 1.0).normalized();
  *room_from_reference_ = {
      rotation_from_vector(bump_.rotation_rad * about) * room_from_reference_->rotation(),
      room_from_reference_->translation() + bump_.translation_m * way};
  bump_ = {};
}

void RoomSimulation::shift_patient() {
  if (shift_.shift_m > 0.0 && wires_driven_ >= shift_.after_wires) {
    slipped_m_ = shift_.shift_m * normal_vector(shifting_, 1.0).normalized();
    shift_ = {};
  }
}

/// Without a surgeon the tools hover side by side over the table, slowly rotating.
void RoomSimulation::let_tools_hover(RoomState& now) const {
  constexpr double kApart_m = 0.14;
  constexpr double kRound_m = 0.02;
  constexpr double kRound_hz = 0.05;
  const double middle = 0.5 * (static_cast<double>(room_.tools.size()) - 1.0);
  for (std::size_t i = 0; i < room_.tools.size(); ++i) {
    const double angle_rad =
        2.0 * std::numbers::pi * kRound_hz * seconds_in(now.time) + static_cast<double>(i);
    const Vec3 place{kRound_m * std::cos(angle_rad), 0.03 + kRound_m * std::sin(angle_rad),
                     kApart_m * (static_cast<double>(i) - middle)};
    const Vec3 axis =
        Vec3{-0.4 + 0.1 * std::sin(angle_rad), 0.9, 0.1 * std::cos(angle_rad)}.normalized();
    put(now, i, {layout_.middle() + place, axis, 0.0}, std::nullopt);
  }
}

void RoomSimulation::put(RoomState& state, std::size_t tool, const Grip& grip,
                         std::optional<Vec3> contact, bool on_wire) const {
  const RoomTool& made = room_.tools[tool];
  Grip shaken = grip;
  if (made.kind != ToolKind::kReference) {
    const double t = seconds_in(state.time);
    Vec3 shake = tremor_m_.at(t);
    // The bone does not yield: a motion into it becomes one along it.
    if (contact) {
      shake = shake - std::min(0.0, shake.dot(*contact)) * *contact;
    }
    if (on_wire) {
      shake = shake.dot(grip.axis) * grip.axis;
    } else {
      shaken.axis = rotation_from_vector(tremor_rad_.at(t)) * grip.axis;
    }
    shaken.tip = grip.tip + shake;
  }
  const Point<Room> tag = shaken.tip + made.tip_in_marker.v.norm() * shaken.axis;
  const Vec3 viewer = state.room_from_rig.translation();
  state.room_from_marker[tool] = held(made, shaken, (viewer - tag.v).normalized());
  state.tool_present[tool] = true;
}

RoomSimulation::Around RoomSimulation::around(Timestamp time) const {
  const std::size_t newest = steps_ - 1;
  const std::size_t oldest = steps_ > kKept ? steps_ - kKept : 0;
  const auto number =
      std::clamp<std::int64_t>((time - start_) / kStep, static_cast<std::int64_t>(oldest),
                               static_cast<std::int64_t>(newest));
  const auto before = static_cast<std::size_t>(number);
  const RoomState& state = kept(before);
  const double fraction = std::clamp(seconds(time - state.time) / seconds(kStep), 0.0, 1.0);
  return {state, kept(std::min(before + 1, newest)), fraction};
}

void RoomSimulation::state_at(Timestamp time, RoomState& state) const {
  const auto [before, after, fraction] = around(time);
  state = after;
  state.time = time;
  state.room_from_rig = interpolated(before.room_from_rig, after.room_from_rig, fraction);
  for (std::size_t i = 0; i < state.room_from_marker.size(); ++i) {
    if (before.tool_present[i] && after.tool_present[i]) {
      state.room_from_marker[i] =
          interpolated(before.room_from_marker[i], after.room_from_marker[i], fraction);
    }
  }
  if (before.hand && after.hand) {
    state.hand = *before.hand + fraction * (*after.hand - *before.hand);
  }
}

Transform<Room, Rig> RoomSimulation::room_from_rig(Timestamp time) const {
  const auto [before, after, fraction] = around(time);
  return interpolated(before.room_from_rig, after.room_from_rig, fraction);
}

Transform<World, Room> RoomSimulation::world_from_room(Timestamp time) const {
  const auto [translation_m, rotation_rad] = drift_.at(seconds_in(time));
  const Transform<World, Room> start = kMapAtStart;
  return start * Transform<Room, Room>{rotation_from_vector(rotation_rad), translation_m};
}

}  // namespace orthonav::sim
