#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/length_text.h"
#include "engine/session/session.h"

namespace orthonav::engine {
namespace {

/// "1.2 mm"; "-- mm" for what is not finite.
std::string millimetres(double length_m, int decimals) {
  return std::isfinite(length_m) ? in_mm(length_m, decimals) : "-- mm";
}

}  // namespace

void Session::say(std::string message, Timestamp time) {
  message_ = std::move(message);
  message_until_ = time + options_.message_for;
}

/// A surgeon who was misheard must see it at once, and one who was heard need not ask.
void Session::echo(const Phrase& phrase, bool sure) {
  heard_ = "heard: " + phrase.text + (sure ? "" : "? not sure");
  heard_until_ = phrase.time + options_.heard_for;
}

void Session::write_step_text() {
  std::array<char, 160> text{};
  const std::string& label = level().plan.label;
  const char* name = name_of(step_).data();
  switch (step_) {
    case Step::kSetup:
    case Step::kDone:
      guidance_.step_text = name;
      break;
    case Step::kDigitize:
    case Step::kVerify:
    case Step::kAccepted:
      std::snprintf(text.data(), text.size(), "%s %s", name, label.c_str());
      guidance_.step_text = text.data();
      break;
    case Step::kGuide:
      std::snprintf(text.data(), text.size(), "%s %s %s", name, label.c_str(),
                    name_of(level().plan.screws[screw_].side));
      guidance_.step_text = text.data();
      break;
    case Step::kRod:
      std::snprintf(text.data(), text.size(), "%s %s", name, name_of(rods_[rod_].side));
      guidance_.step_text = text.data();
      break;
  }
}

/// The loss of the tool comes first: no message may cover it.
void Session::write_detail() {
  if (guidance_.frame_time >= message_until_) {
    message_.clear();
  }
  if (guidance_.frame_time >= heard_until_) {
    heard_.clear();
  }
  guidance_.heard = heard_;
  guidance_.detail.clear();
  const auto tool = active_tool();
  const bool lost = tool && seen_ != Seen::kMeasured && seen_ != Seen::kNever;
  if (lost) {
    guidance_.detail = tracker_->tools()[*tool].name + " lost";
  }
  const std::string warning = lost ? std::string() : tag_size_warning();
  if (!warning.empty()) {
    guidance_.detail = warning;
  }
  const bool taken = lost || !warning.empty();
  if (!message_.empty()) {
    guidance_.detail += (taken ? "; " : "") + message_;
  } else if (!taken) {
    write_state_of_step();
  } else if (checks_by_touch()) {
    // What is to be touched counts on beside a warning that stays.
    guidance_.detail += "; ";
    write_what_to_check();
  }
}

bool Session::checks_by_touch() const {
  return step_ == Step::kVerify && method_.verification == Verification::kByTouch;
}

void Session::write_what_to_check() {
  const auto& points = level().check_points;
  const nav::CheckVerdict verdict = nav::verdict_on(points, options_.check_points);
  std::string& out = guidance_.detail;
  if (!points.empty() && points.back().within) {
    out += "check point " + std::to_string(points.size()) + ": " +
           millimetres(points.back().distance_m, 1) + " off; ";
  }
  out += verdict.passed ? "checked, worst " + millimetres(verdict.worst_m, 1) : verdict.advice;
}

/// Of the tool in use: a tag that is not as large as its tool's definition says gives wrong poses.
std::string Session::tag_size_warning() const {
  const auto tool = active_tool();
  const auto size = tool ? tracker_->tag_size(*tool) : std::nullopt;
  if (!size || !size->disagrees) {
    return {};
  }
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%s: tag %.1f %% %s than stated, check print and unit",
                tracker_->tools()[*tool].name.c_str(), 100.0 * std::abs(size->fraction),
                size->fraction > 0.0 ? "larger" : "smaller");
  return text.data();
}

void Session::write_state_of_step() {
  std::string& out = guidance_.detail;
  const auto& registration = level().registration;
  if (step_ == Step::kDigitize) {
    std::size_t points = 0;
    for (const nav::Region& region : digitizer_.regions()) {
      points += region.samples.size();
    }
    out = std::to_string(points) + " points";
    if (coach_ && coach_->newest()) {
      out += " | " + text_of(*coach_->newest());
    }
  } else if (checks_by_touch() && registration) {
    out = millimetres(nav::worst_m(level().predicted), 1) + " expected; ";
    write_what_to_check();
  } else if ((step_ == Step::kVerify || step_ == Step::kAccepted) && registration) {
    out = "RMSE " + millimetres(registration->rmse_m, 2) + ", " +
          millimetres(nav::worst_m(level().predicted), 1) + " expected at the screws";
  } else if (step_ == Step::kGuide && registration) {
    out = "RMSE " + millimetres(registration->rmse_m, 2) + ", " +
          millimetres(level().predicted[screw_].worst_m(), 1) + " expected";
  } else if (step_ == Step::kRod) {
    out = std::to_string(rods_[rod_].heads.size()) + " heads";
  }
}

}  // namespace orthonav::engine
