#include "engine/session/steps/rod_templating.h"
#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/text/wording.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace orthonav::engine {
namespace {

/// Below this probability that every seat lies within the limit, a head is to be touched again.
constexpr double kExpectedEnough = 0.95;

struct PlacedScrew {
  Vec3 entry;
  Vec3 to_tip;
  double diameter_m = 0.0;
};

std::vector<PlacedScrew> screws_in_world(std::span<const LevelState> levels, nav::Side side) {
  std::vector<PlacedScrew> screws;
  for (const LevelState& level : levels) {
    if (!level.registration || level.map_moved) {
      continue;
    }
    const auto& world_from_vertebra = level.registration->world_from_vertebra;
    for (const nav::ScrewPlan& screw : level.plan.screws) {
      if (screw.side == side) {
        const Vec3 entry = (world_from_vertebra * screw.entry).v;
        screws.push_back(
            {entry, (world_from_vertebra * screw.target).v - entry, 2.0 * screw.radius_m});
      }
    }
  }
  return screws;
}

/// For each head, the screw with the nearest entry; empty without screws.
std::vector<PlacedScrew> nearest_screws(std::span<const Vec3> heads_m,
                                        const std::vector<PlacedScrew>& screws) {
  std::vector<PlacedScrew> nearest_ones;
  for (const Vec3& head_m : screws.empty() ? std::span<const Vec3>() : heads_m) {
    const auto nearest = std::min_element(
        screws.begin(), screws.end(), [&](const PlacedScrew& a, const PlacedScrew& b) {
          return (a.entry - head_m).squared_norm() < (b.entry - head_m).squared_norm();
        });
    nearest_ones.push_back(*nearest);
  }
  return nearest_ones;
}

std::vector<Vec3> directions_of(const std::vector<PlacedScrew>& screws) {
  std::vector<Vec3> directions;
  for (const PlacedScrew& screw : screws) {
    directions.push_back(screw.to_tip);
  }
  return directions;
}

/// The seating of each screw, if the list of screws states it.
nav::RodSeating seating_of(const std::vector<PlacedScrew>& screws, const SessionOptions& options,
                           double overhang_m) {
  nav::RodSeating seating{options.head_to_seat_m, overhang_m, {}};
  for (const PlacedScrew& screw : screws) {
    seating.each_head_to_seat_m.push_back(
        options.replan.sizes.head_to_seat_m(screw.diameter_m).value_or(options.head_to_seat_m));
  }
  return seating;
}

/// Where the rod lies below the touched heads: along the nearest screw of this side among the
/// registered levels; where rods alone are bent, to where the pointer pointed.
Result<nav::RodCut> seats(RodState& rod, const SessionOptions& options,
                          std::span<const LevelState> levels, double overhang_m) {
  const nav::RodTemplate& shape = *rod.rod;
  const auto screws = nearest_screws(shape.heads_m, screws_in_world(levels, rod.side));
  if (!screws.empty()) {
    return nav::rod_cut(shape, directions_of(screws), seating_of(screws, options, overhang_m));
  }
  if (!levels.empty()) {
    return Error{"the direction of no screw is known"};
  }
  const auto to_bone = nav::to_bone_across(shape, rod.touched.pointed());
  if (!to_bone) {
    return Error{"by the pointer the " + to_bone.error().message};
  }
  rod.seat_by_pointer_m = options.head_to_seat_m;
  return nav::rod_cut(shape, *to_bone, {options.head_to_seat_m, overhang_m, {}});
}

/// Says of the instructed rod how surely it will lie in the true heads.
void expect(RodState& rod) {
  std::vector<double> seat_sd_m;
  std::vector<std::size_t> heads;  // of the seats, which are in order along the rod
  for (const Vec3& head_m : rod.rod->heads_m) {
    const auto at = std::find(rod.heads.begin(), rod.heads.end(), Point<World>{head_m});
    heads.push_back(static_cast<std::size_t>(at - rod.heads.begin()));
    seat_sd_m.push_back(rod.touched.sd_m(heads.back()));
  }
  rod.expected = nav::rod_expectation(rod.instructions->fit, seat_sd_m);
  rod.expected->least_sure = heads[rod.expected->least_sure];
}

void instruct(RodState& rod, const SessionOptions& options, std::span<const LevelState> levels) {
  const nav::RodBending bending = options.bending();
  const auto cut = seats(rod, options, levels, bending.overhang_m);
  auto told = cut ? nav::rod_instructions(cut->seats_m, bending)
                  : Result<nav::RodInstructions>(cut.error());
  if (told) {
    rod.instructions = *std::move(told);
    expect(rod);
  } else {
    rod.no_instructions = told.error().message;
  }
}

/// Makes the template from the present heads, and the instructions to bend it, or says why there is
/// no template.
void bend(RodState& rod, SessionState& work, Timestamp time) {
  rod.rod.reset();
  rod.instructions.reset();
  rod.no_instructions.clear();
  rod.seat_by_pointer_m.reset();
  rod.expected.reset();
  if (rod.heads.size() < 2) {
    return;
  }
  std::vector<Vec3> heads;
  for (const Point<World>& head : rod.heads) {
    heads.push_back(head.v);
  }
  auto made = nav::rod_template(heads, work.options.rod_diameter_m);
  if (!made) {
    return work.messages.say(NoRod{made.error()}, time);
  }
  rod.rod = std::move(*made);
  instruct(rod, work.options, work.state.levels);
}

}  // namespace

bool rod_planned(std::span<const LevelState> levels, nav::Side side) {
  std::size_t screws = 0;
  for (const LevelState& level : levels) {
    for (const nav::ScrewPlan& screw : level.plan.screws) {
      screws += screw.side == side ? 1 : 0;
    }
  }
  return screws >= 2;
}

bool any_rod_planned(std::span<const LevelState> levels) {
  return rod_planned(levels, nav::Side::kLeft) || rod_planned(levels, nav::Side::kRight);
}

RodTemplating::RodTemplating(bool left_planned, bool right_planned)
    : planned_{left_planned, right_planned}, current_(right_planned && !left_planned ? 1 : 0) {}

std::optional<Event> RodTemplating::begin(SessionState& work) const {
  work.touches.drop();
  return left_to_do(work.state) ? std::nullopt : std::optional(Event::kNoSideLeft);
}

void RodTemplating::record_head(SessionState& work, Timestamp time) {
  const TouchedPlace place = take_place(work, time);
  const auto* head = std::get_if<nav::PressedPlace>(&place);
  if (!head) {
    return work.messages.say(
        TouchNotRecorded{TouchNotRecorded::What::kHead, std::get<TouchRefusal>(place)}, time);
  }
  RodState& rod = current(work);
  if (rod.touched.empty()) {
    rod.touched = TouchedHeads(work.anchored());
  }
  const std::size_t pointer = work.tools.pointer();
  const Direction<World> shaft = work.tools.watch(pointer).last_measured_pose().value *
                                 work.tools.geometry(pointer).axis_in_marker;
  const auto added = rod.touched.add(*head, shaft.v);
  if (const auto* refusal = std::get_if<TouchRefusal>(&added)) {
    return work.messages.say(TouchNotRecorded{TouchNotRecorded::What::kHead, *refusal}, time);
  }
  rod.heads = rod.touched.places();
  rod.first_touch = rod.first_touch.value_or(time);
  bend(rod, work, time);
  work.observer->head_recorded(time, rod.side, std::get<HeadTouch>(added));
}

void RodTemplating::drop_head(SessionState& work, Timestamp time) {
  RodState& rod = current(work);
  const auto dropped = rod.touched.drop_last();
  if (!dropped) {
    return work.messages.say(NothingToDelete{NothingToDelete::What::kHead}, time);
  }
  if (dropped->touches == 1) {
    // Without `places`, which allocates: a head can be taken back where memory has run out.
    rod.heads.pop_back();
  } else {
    rod.heads = rod.touched.places();
  }
  bend(rod, work, time);
  work.observer->head_dropped(time, rod.side, *dropped);
}

Event RodTemplating::finish_rod(SessionState& work, Timestamp time) {
  RodState& rod = current(work);
  if (rod.first_touch && rod.rod) {
    rod.took_s = seconds(time - *rod.first_touch);
  }
  work.observer->rod_done(time, rod);
  return finish(work.state) ? Event::kAnotherSide : Event::kNoSideLeft;
}

bool RodTemplating::finish(OperationState& operation) {
  operation.rods[current_].done = true;
  const bool another = current_ + 1 < planned_.size() && planned_[current_ + 1];
  if (another) {
    ++current_;
  }
  return another;
}

HeadsSoFar RodTemplating::state(const SessionState& work) const {
  const RodState& now = work.state.rods[current_];
  HeadsSoFar out;
  out.unplanned = work.rods_alone();
  out.count = now.heads.size();
  if (!now.touched.empty()) {
    out.last = now.touched.last();
  }
  if (now.instructions) {
    out.cut_length_m = now.instructions->cut_length_m();
    out.bends = now.instructions->bends.size();
    out.seat_by_pointer_m = now.seat_by_pointer_m;
  }
  if (now.expected && now.expected->within < kExpectedEnough) {
    out.touch_again = now.expected->least_sure;
  }
  return out;
}

void RodTemplating::write(const SessionState& work, Guidance& out) const {
  out.rods = work.state.rods;
  out.rods_moved_away = moved_away_;
}

void RodTemplating::resume(const OperationState& operation) {
  while (current_ + 1 < planned_.size() && operation.rods[current_].done &&
         planned_[current_ + 1]) {
    ++current_;
  }
}

// Its records.

namespace {

std::optional<double> number_if(const JsonNode& node, const char* key) {
  return node.has(key) ? std::optional(node.number(key)) : std::nullopt;
}

}  // namespace

void log_head(LogJson& json, nav::Side side, const HeadTouch& touch) {
  json["side"] = name_of(side);
  json["head"] = touch.head;
  json["touches"] = touch.touches;
  json["in_world_m"] = json_of(touch.place.v);
  json["sd_m"] = touch.sd_m;
  json["head_sd_m"] = touch.head_sd_m;
}

void log_head_dropped(LogJson& json, nav::Side side, const HeadTouch& touch) {
  json["side"] = name_of(side);
  json["head"] = touch.head;
  json["touches"] = touch.touches - 1;
}

void read_head(const JsonNode& node, bool dropped, bool anchored, RodState& rod) {
  if (rod.touched.empty()) {
    rod.touched = TouchedHeads(anchored);
  }
  if (dropped) {
    rod.touched.drop_last();
  } else if (const auto added = rod.touched.add({{node.vec3("in_world_m")}, node.number("sd_m")});
             !std::holds_alternative<HeadTouch>(added)) {
    return node.refuse("in_world_m", "is not where its head was touched before");
  }
  rod.heads = rod.touched.places();
}

void log_rod(LogJson& json, const RodState& rod) {
  json["side"] = name_of(rod.side);
  json["heads"] = rod.heads.size();
  if (rod.rod) {
    json["length_m"] = rod.rod->length_m;
    json["bends"] = LogJson::array();
    for (const nav::RodBend& bend : rod.rod->bends) {
      json["bends"].push_back({{"arc_length_m", bend.arc_length_m}, {"angle_rad", bend.angle_rad}});
    }
  }
  if (rod.took_s) {
    json["took_s"] = *rod.took_s;
  }
  json["no_instructions"] = rod.no_instructions;
  if (rod.instructions) {
    json["cut_length_m"] = rod.instructions->cut_length_m();
    json["instructions"] = LogJson::array();
    for (const nav::RodInstruction& bend : rod.instructions->bends) {
      json["instructions"].push_back({{"centre_m", bend.arc.centre_m},
                                      {"roll_rad", bend.arc.roll_rad},
                                      {"angle_rad", bend.arc.angle_rad},
                                      {"set_rad", bend.set_rad}});
    }
  }
  if (rod.seat_by_pointer_m) {
    json["seat_by_pointer_m"] = *rod.seat_by_pointer_m;
  }
  if (rod.expected) {
    json["expected_within"] = rod.expected->within;
    json["least_sure"] = rod.expected->least_sure;
  }
}

void read_rod(const JsonNode& node, RodState& rod) {
  rod.done = true;
  if (node.has("length_m")) {
    rod.rod.emplace().length_m = node.number("length_m");
    for (const JsonNode& bend : node.list("bends")) {
      rod.rod->bends.push_back({bend.number("arc_length_m"), bend.number("angle_rad"), {}});
    }
  }
  rod.took_s = number_if(node, "took_s");
  rod.no_instructions = node.text("no_instructions");
  if (node.has("cut_length_m")) {
    rod.instructions.emplace().fit.length_m = node.number("cut_length_m");
    for (const JsonNode& bend : node.list("instructions")) {
      nav::RodInstruction& read = rod.instructions->bends.emplace_back();
      read.arc.centre_m = bend.number("centre_m");
      read.arc.roll_rad = bend.number("roll_rad");
      read.arc.angle_rad = bend.number("angle_rad");
      read.set_rad = bend.number("set_rad");
    }
  }
  rod.seat_by_pointer_m = number_if(node, "seat_by_pointer_m");
  if (node.has("expected_within")) {
    rod.expected =
        nav::RodExpectation{node.number("expected_within"), count_from(node, "least_sure")};
  }
}

// Its words.

void write_heads(PartedText text, const HeadsSoFar& heads) {
  std::string& out = text.out;
  text.begin(Importance::kNext);
  if (heads.touch_again) {
    append_printed(out, translated("touch head %zu again"), *heads.touch_again + 1);
  } else if (heads.cut_length_m) {
    out += heads.bends == 0 ? translated("cut it, then say finish rod")
                            : translated("bend it, then say finish rod");
  } else if (heads.count > 0) {
    out += translated("touch the next head");
  } else {
    out += heads.unplanned ? translated("first head, or say finish rod")
                           : translated("touch the first head");
  }
  if (heads.seat_by_pointer_m) {
    const double seat_m = *heads.seat_by_pointer_m;
    text.begin(Importance::kFigures, "; ");
    append_printed(out,
                   seat_m < 0.0 ? translated("rod %s above the touches")
                                : translated("rod %s below the touches"),
                   format_mm(std::abs(seat_m)).c_str());
  }
}

}  // namespace orthonav::engine
