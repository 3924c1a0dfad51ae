#include "engine/session/steps/verifying.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/text/wording.h"
#include "nav/guidance/predicted_error.h"
#include "nav/registration/check_points.h"
#include "nav/registration/presses.h"

namespace orthonav::engine {
namespace {

std::vector<float> distances_m(const LevelState& level) {
  const auto vertebra_from_world = level.registration->world_from_vertebra.inverse();
  const auto& surface = level.plan.model->reachable_surface();
  std::vector<float> each_m;
  for (const Point<World>& point : level.newest->points) {
    const auto nearest = surface.nearest((vertebra_from_world * point).v);
    each_m.push_back(nearest ? static_cast<float>(nearest->distance_m)
                             : std::numeric_limits<float>::infinity());
  }
  return each_m;
}

/// Averages over a stretch of the stroke, because single samples are noisy.
std::vector<float> smoothed(std::span<const float> each_m) {
  constexpr std::size_t kStretch = 10;
  std::vector<float> smooth_m;
  for (std::size_t i = 0; i < each_m.size(); ++i) {
    const std::size_t first = i - std::min(i, kStretch);
    const std::size_t last = std::min(i + kStretch + 1, each_m.size());
    float sum = 0.0f;
    for (std::size_t k = first; k < last; ++k) {
      sum += each_m[k];
    }
    smooth_m.push_back(sum / static_cast<float>(last - first));
  }
  return smooth_m;
}

}  // namespace

Verifying::Verifying(SessionState& work, Timestamp registered, Verifying before)
    : options_(work.options),
      by_touch_(work.method.verification == Verification::kByTouch),
      anchored_(work.anchored()),
      strokes_(work.level().registration),
      pressed_on_(work.level_in_work),
      registered_(registered),
      residuals_m_(smoothed(distances_m(work.level()))),
      unstroked_(nav::unstroked_surface(*work.level().plan.model,
                                        work.level().registration->world_from_vertebra,
                                        work.level().newest->points)) {
  LevelState& level = work.level();
  if (!before.strokes_ && before.pressed_on_ == pressed_on_) {
    pressed_ = std::move(before.pressed_);
  }
  if (!anchored_) {
    // While more places are touched, the map moves by more than they reveal.
    options_.check_points.enough = 3;
  }
  if (by_touch_) {
    limits_.targets = nav::entries_and_targets(level.plan.screws);
    places_ = nav::places_to_check(*level.plan.model, level.registration->world_from_vertebra,
                                   level.newest->points, options_.check_points);
  }
  judge(level);
}

Verifying Verifying::rejected(const SessionState& work) && {
  Verifying out;
  if (anchored_ && verdict_.advice.kind == nav::CheckAdvice::Kind::kUncertain) {
    const std::size_t older = pressed_.size() - std::min(pressed_.size(), nav::kMaxCheckPoints);
    out.pressed_.assign(pressed_.begin() + static_cast<std::ptrdiff_t>(older), pressed_.end());
    out.pressed_on_ = work.level_in_work;
    for (nav::PressedPlace& place : out.pressed_) {
      place.time_s = 0.0;
    }
  }
  return out;
}

void Verifying::begin_again(LevelState& level, double moved_m) {
  // Earlier places are no longer checks but still show where the bone is. They are joined with the
  // same strokes and model, so that neither counts twice, and with World's drift since then.
  constexpr std::size_t kMaxEarlier = nav::kMaxCheckPoints;
  if (!anchored_) {
    strokes_ = level.registration;
    pressed_.clear();
  } else if (pressed_.size() > kMaxEarlier) {
    pressed_.erase(pressed_.begin(), pressed_.end() - kMaxEarlier);
  }
  level.check_points.clear();
  moved_m_ = moved_m;
  if (by_touch_) {
    // A screw may have been changed in the meantime.
    limits_.targets = nav::entries_and_targets(level.plan.screws);
  }
  visible_at_.reset();
  judge(level);
}

void Verifying::judge(LevelState& level) {
  joined_.reset();
  next_.reset();
  const nav::VertebraModel& model = *level.plan.model;
  const nav::PressModel press = press_model();
  const auto fit = by_touch_ && !pressed_.empty()
                       ? nav::fit_presses(model, *strokes_, pressed_, press)
                       : std::nullopt;
  if (fit) {
    joined_ = nav::with_places(model, *strokes_, *fit, press, limits_);
    next_ =
        nav::place_to_press(model, *strokes_, level.newest->points, pressed_, *fit, press, limits_);
  }
  if (strokes_->provisional) {
    // The registration includes the touched places, so it is shown with them.
    put(joined_ ? *joined_ : *strokes_, level);
  }
  for (nav::CheckPoint& point : level.check_points) {
    point = nav::check_point(model, level.registration->world_from_vertebra, point.place,
                             options_.check_points);
  }
  if (fit) {
    nav::weigh(*fit, level.check_points);
    verdict_ = nav::verdict_on(level.check_points, options_.check_points, *joined_, next_);
  } else {
    verdict_ = nav::verdict_on(level.check_points, options_.check_points);
  }
  propose(level);
}

nav::PressModel Verifying::press_model() const {
  nav::PressModel press;
  // On the map no number of places would meet the limits with it.
  press.model_in_limits = anchored_;
  const double first_s = pressed_.empty() ? 0.0 : pressed_.front().time_s;
  const double last_s = pressed_.empty() ? 0.0 : pressed_.back().time_s;
  const double drift = options_.map_drift_m_per_sqrt_s;
  press.moved_sd_m =
      std::max(press.moved_sd_m, std::hypot(strokes_->common.map_m, drift * std::sqrt(first_s)));
  press.since_sd_m = drift * std::sqrt(std::max(0.0, last_s - first_s));
  return press;
}

void Verifying::propose(const LevelState& level) {
  to_check_ = nav::still_to_check(places_, level.check_points);
  if (to_check_.empty() && next_ && !verdict_.passed) {
    to_check_.assign(1, next_->place);
  }
}

void Verifying::put(const nav::Registration& registration, LevelState& level) {
  level.registration = registration;
  level.predicted = nav::predicted_errors(registration, level.plan.screws);
}

void Verifying::record_check(SessionState& work, Timestamp time) {
  if (const auto refusal = add(work.level(), take_place(work, time), time)) {
    work.messages.say(TouchNotRecorded{TouchNotRecorded::What::kCheckPoint, *refusal}, time);
  } else {
    work.observer->check_point_recorded(time, work.level());
  }
}

/// Adds the place, or says why it does not count.
std::optional<TouchRefusal> Verifying::add(LevelState& level, const TouchedPlace& place,
                                           Timestamp time) {
  const auto* touched = std::get_if<nav::PressedPlace>(&place);
  if (!touched) {
    return std::get<TouchRefusal>(place);
  }
  if (level.check_points.size() >= nav::kMaxCheckPoints) {
    return TouchRefusal{TouchRefusal::Kind::kTooMany};
  }
  pressed_.push_back(*touched);
  pressed_.back().time_s = std::max(0.0, seconds(time - registered_));
  level.check_points.emplace_back().place = touched->place;
  judge(level);
  return std::nullopt;
}

void Verifying::drop_check(SessionState& work, Timestamp time) {
  LevelState& level = work.level();
  if (level.check_points.empty()) {
    return work.messages.say(NothingToDelete{NothingToDelete::What::kCheckPoint}, time);
  }
  pressed_.pop_back();
  level.check_points.pop_back();
  judge(level);
  work.observer->check_point_dropped(time, level);
}

void Verifying::accept(SessionState& work, Timestamp time) const {
  LevelState& level = work.level();
  if (joined_) {
    put(*joined_, level);
    level.newest->registration = *joined_;
  }
  level.accepted = true;
  level.unverified = false;
  level.bone_found = BoneFound{time, 0.0, work.options.map_drift_m_per_sqrt_s};
  work.observer->accepted(time, level, shown_);
}

void Verifying::write(const SessionState& work, Guidance& out) {
  out.residuals_m = {};
  out.unstroked = {};
  out.to_check = {};
  if (work.step != Step::kVerify) {
    return;
  }
  if (!visible_at_ && !work.stalled) {
    visible_at_ = out.display_time;
  }
  out.residuals_m = residuals_m_;
  out.unstroked = unstroked_;
  out.to_check = to_check_;
}

void Verifying::note_shown(const StatusLine& line) {
  constexpr std::size_t kLongLine = 512;
  shown_.clear();
  shown_.reserve(kLongLine);
  append_status(shown_, line);
}

StepState Verifying::state(const SessionState& work) const {
  const LevelState& level = work.level();
  if (!level.registration) {
    return {};
  }
  if (!work.options.steps.check_points) {
    return ByEye{};
  }
  return ChecksSoFar{&verdict_, moved_m_};
}

// Its records.

void log_check_point(LogJson& json, const LevelState& level) {
  const nav::CheckPoint& point = level.check_points.back();
  json["in_world_m"] = json_of(point.place.v);
  json["distance_m"] = point.distance_m;
  json["limit_m"] = point.limit_m;
  json["within"] = point.within;
}

void read_check_point(const JsonNode& node, LevelState& level) {
  level.check_points.push_back({{node.vec3("in_world_m")},
                                bounded(node, "distance_m"),
                                node.flag_or("within", false),
                                bounded(node, "limit_m")});
}

void read_check_point_dropped(LevelState& level) {
  if (!level.check_points.empty()) {
    level.check_points.pop_back();
  }
}

void log_acceptance(LogJson& json, const LevelState& level, std::string_view shown) {
  json["shown"] = shown;
  json["registration"] = json_of(*level.registration);
  json["check_points"] = level.check_points.size();
}

void read_acceptance(const JsonNode& node, LevelState& level) {
  level.registration = registration_from(node.child("registration"));
  level.accepted = true;
}

// Its words.

namespace {

constexpr const char* kSayReject = translatable("say reject level");

void append(std::string& out, const nav::CheckAdvice& advice) {
  switch (advice.kind) {
    case nav::CheckAdvice::Kind::kNone:
      break;
    case nav::CheckAdvice::Kind::kTouchApart:
      if (advice.number == 3) {
        append_printed(out, translated("touch 3 places, %.0f mm apart"), advice.value_m * 1e3);
      } else {
        append_printed(out,
                       advice.number == 1
                           ? translated("touch %zu more place, %.0f mm from the others")
                           : translated("touch %zu more places, %.0f mm from the others"),
                       advice.number, advice.value_m * 1e3);
      }
      break;
    case nav::CheckAdvice::Kind::kTouchOffLine:
      append_printed(out, translated("touch 1 more place, %.0f mm off their line"),
                     advice.value_m * 1e3);
      break;
    case nav::CheckAdvice::Kind::kReject:
      append_beside_limit(out, translated("%.1f mm off, limit %.1f mm"), advice.value_m * 1e3,
                          advice.limit_m * 1e3);
      out.append(": ").append(translated(kSayReject));
      break;
    case nav::CheckAdvice::Kind::kTouchMore:
      out += translated("touch 1 more place");
      break;
    case nav::CheckAdvice::Kind::kUncertain:
      append_beside_limit(out, translated("screws ≤ %.1f mm off, limit %.1f mm"),
                          advice.value_m * 1e3, advice.limit_m * 1e3);
      out.append(": ").append(translated(kSayReject));
      break;
  }
}

}  // namespace

std::string text_of(const nav::CheckAdvice& advice) {
  std::string out;
  append(out, advice);
  return out;
}

void write(PartedText text, const SaidBeforeShown& /*m*/) {
  std::string& out = text.out;
  text.begin(Importance::kMessage);
  out += translated("not accepted: said before the hologram was shown");
}

void write(PartedText text, const ChecksMissing& m) {
  std::string& out = text.out;
  text.begin(Importance::kNext);
  out.append(translated("not accepted:")).append(" ");
  append(out, m.advice);
}

void write_checks(PartedText text, const ChecksSoFar& checks, std::string_view separator) {
  if (checks.moved_m) {
    text.begin(Importance::kDanger, separator);
    append_printed(text.out, translated("moved %s"), format_mm(*checks.moved_m).c_str());
  }
  text.begin(Importance::kNext, checks.moved_m ? "; " : separator);
  if (checks.verdict->passed) {
    text.out += translated("passed: say accept result");
  } else {
    append(text.out, checks.verdict->advice);
  }
}

}  // namespace orthonav::engine
