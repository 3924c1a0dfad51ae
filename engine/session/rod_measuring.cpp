#include "engine/session/rod_measuring.h"

#include <cmath>
#include <utility>
#include <vector>

namespace orthonav::engine {
namespace {

void refuse_rod(OperationInWork& work, RodNotMeasured why, Timestamp time) {
  work.messages.say(std::move(why), time);
}

/// The last of `arcs`, which are as instructed.
Result<nav::MeasuredBend> bend_as_stroked(std::span<const nav::RodArc> arcs, double length_m,
                                          const SessionOptions& options,
                                          std::span<const Vec3> points_m) {
  const RodInHandRules& rules = options.rod_in_hand;
  nav::RodStrokeRules stroke = rules.stroke;
  auto found = nav::measured_bend(arcs, length_m, options.rod_diameter_m, points_m, stroke);
  const auto expected = [&](double value_rad, double told_rad, double sd_rad) {
    return std::abs(value_rad - told_rad) <= rules.surprise_sds * sd_rad;
  };
  const nav::RodArc& told = arcs.back();
  if (found && expected(found->arc.angle_rad, told.angle_rad, stroke.angle_sd_rad) &&
      expected(found->arc.roll_rad, told.roll_rad, stroke.roll_sd_rad)) {
    return found;
  }
  stroke.angle_sd_rad *= 4.0;
  stroke.roll_sd_rad *= 4.0;
  return nav::measured_bend(arcs, length_m, options.rod_diameter_m, points_m, stroke);
}

}  // namespace

void RodMeasuring::button(Action action, Timestamp time) {
  if (action == Action::kBeginTouch) {
    strokes_.press(time);
  } else if (action == Action::kEndTouch) {
    strokes_.release(time);
  }
}

void RodMeasuring::collect(const WatchedTools& tools) {
  if (stroking_) {
    const nav::ToolGeometry& tool = tools.geometry(tools.pointer());
    strokes_.add(tools.watch(tools.pointer()).newest(), tool.tip_in_marker, tool.axis_in_marker);
  }
}

void RodMeasuring::stroke_next(RodState& rod, std::size_t made) {
  made_ = made;
  stroking_ = true;
  strokes_.clear();
  rod.lying.reset();
}

void RodMeasuring::next(RodState& rod, OperationInWork& work, Timestamp time) {
  using enum RodNotMeasured::Kind;
  if (!rod.instructions) {
    return refuse_rod(work, {kNoInstructions}, time);
  }
  if (!made_) {
    lost_.reset();
    return stroke_next(rod, 0);
  }
  if (stroking_ && *made_ > 0) {
    return refuse_rod(work, {kMeasureFirst, *made_}, time);
  }
  if (*made_ >= rod.instructions->bends.size()) {
    return refuse_rod(work, {kAllMade}, time);
  }
  stroke_next(rod, *made_ + 1);
}

void RodMeasuring::save(RodState& rod, OperationInWork& work, Timestamp time) {
  if (!stroking_) {
    return work.messages.say(NotPossibleNow{Event::kSaySave}, time);
  }
  std::vector<Vec3> points_m;
  Timestamp newest{};
  for (const nav::Region& region : strokes()) {
    for (const nav::Sample& sample : region.samples) {
      points_m.push_back(sample.tip_in_world.v);
      newest = sample.time;
    }
  }
  std::optional<LyingRod> lying = measured(rod, work, points_m, time);
  if (!lying) {
    return;
  }
  lying->diameter_m = work.options.rod_diameter_m;
  lying->shown_until = newest + work.options.rod_in_hand.shown_for;
  rod.lying = std::move(lying);
  stroking_ = false;
  strokes_.clear();
}

std::optional<LyingRod> RodMeasuring::measured(RodState& rod, OperationInWork& work,
                                               std::span<const Vec3> points_m, Timestamp time) {
  if (*made_ > 0) {
    return measured_after_bend(rod, work, points_m, time);
  }
  const auto laid = nav::laid_rod(rod.instructions->cut_length_m(), work.options.rod_diameter_m,
                                  points_m, work.options.rod_in_hand.stroke);
  if (!laid) {
    refuse_rod(work, {RodNotMeasured::Kind::kRefused, 0, laid.error()}, time);
    return std::nullopt;
  }
  if (laid->one_sided > work.options.rod_in_hand.most_one_sided) {
    refuse_rod(work, {RodNotMeasured::Kind::kOneSide}, time);
    return std::nullopt;
  }
  return lying_rod(*rod.instructions, laid->points_from_rod, laid->rod_in_points_m, laid->length_m);
}

std::optional<LyingRod> RodMeasuring::measured_after_bend(RodState& rod, OperationInWork& work,
                                                          std::span<const Vec3> points_m,
                                                          Timestamp time) {
  const nav::RodInstructions& planned = *rod.instructions;
  const RodInHandRules& rules = work.options.rod_in_hand;
  std::vector<nav::RodArc> made = first_bends(planned, *made_);
  const auto found = bend_as_stroked(made, planned.cut_length_m(), work.options, points_m);
  if (!found) {
    refuse_rod(work, {RodNotMeasured::Kind::kRefused, 0, found.error()}, time);
    return std::nullopt;
  }
  if (found->one_sided > rules.most_one_sided) {
    refuse_rod(work, {RodNotMeasured::Kind::kOneSide}, time);
    return std::nullopt;
  }
  made.back() = found->arc;
  auto after = nav::rod_instructions_after(planned, made, work.options.bending());
  if (!after) {
    give_up(rod, work, after.error(), time);
    return std::nullopt;
  }
  for (std::size_t k = 0; k < made.size(); ++k) {
    after->bends[k].set_rad = planned.bends[k].set_rad;
  }
  rod.measured.push_back({*found, *std::exchange(rod.instructions, *std::move(after))});
  work.observer->rod_bend_measured(time, rod);
  return lying_rod(*rod.instructions, found->points_from_rod, found->rod_in_points_m,
                   rod.instructions->cut_length_m());
}

/// Another rod begins with the instructions for a straight one. "delete" takes it back: the stroke
/// may have been bad.
void RodMeasuring::give_up(RodState& rod, OperationInWork& work, const Error& why, Timestamp time) {
  work.observer->rod_given_up(time, rod, why.message);
  lost_ = Lost{*rod.instructions, rod.measured};
  if (!rod.measured.empty()) {
    rod.instructions = std::move(rod.measured.front().planned);
    rod.measured.clear();
  }
  made_.reset();
  stroking_ = false;
  strokes_.clear();
  refuse_rod(work, {RodNotMeasured::Kind::kRefused, 0, why}, time);
}

void RodMeasuring::drop(RodState& rod, OperationInWork& work, Timestamp time) {
  if (lost_) {
    rod.instructions = std::move(lost_->instructions);
    rod.measured = std::move(lost_->measured);
    lost_.reset();
    work.observer->rod_kept(time, rod);
    return stroke_next(rod, rod.measured.size() + 1);
  }
  if (stroking_ && strokes_.drop()) {
    return;
  }
  if (stroking_ && *made_ == 0) {
    return forget();
  }
  if (stroking_) {
    // Back to the rod before its last bend. It was moved since, so that it is not shown.
    stroke_next(rod, *made_ - 1);
    stroking_ = *made_ == 0;
    return;
  }
  rod.lying.reset();
  if (*made_ > 0) {
    rod.instructions = std::move(rod.measured.back().planned);
    rod.measured.pop_back();
    work.observer->rod_bend_dropped(time, rod);
  }
  stroke_next(rod, *made_);
}

RodInHandSoFar RodMeasuring::state(const RodState& rod) const {
  RodInHandSoFar out;
  out.made = *made_;
  out.stroking = stroking_;
  for (const nav::Region& region : strokes()) {
    out.points += region.samples.size();
  }
  out.last = !stroking_ && *made_ > 0 ? &rod.measured.back().found : nullptr;
  out.next = next_bend_of(*rod.instructions);
  out.shown = rod.lying.has_value();
  if (rod.lying && rod.lying->cut) {
    out.cut_to_m = rod.lying->cut_length_m;
  }
  return out;
}

}  // namespace orthonav::engine
