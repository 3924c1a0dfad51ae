#include "engine/session/steps/landmarking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/guide_checks.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/steps/verifying.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine {
namespace {

double distance_m(Point<World> place, const ReferencePost& post) {
  const Vec3 along = post.foot - post.tag;
  const double length2_m2 = std::max(along.dot(along), 1e-12);
  const double way = std::clamp((place - post.tag).dot(along) / length2_m2, 0.0, 1.0);
  return (place - (post.tag + way * along)).norm();
}

double nearest_m(Point<World> place, std::span<const ReferencePost> posts) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const ReferencePost& post : posts) {
    least_m = std::min(least_m, distance_m(place, post));
  }
  return least_m;
}

/// How far the bone that a pointer can reach extends from the nearest reference.
double farthest_m(const LevelState& level, std::span<const ReferencePost> posts) {
  double most_m = 0.0;
  for (const Vec3 vertex : level.plan.model->reachable().vertices_m) {
    const Point<World> place = level.registration->world_from_vertebra * Point<Vertebra>{vertex};
    most_m = std::max(most_m, nearest_m(place, posts));
  }
  return most_m;
}

/// Notes that the bone was found where it was, by its landmark.
void note_bone_found(LevelState& level, const LandmarkTouch& touch, double drift_m_per_sqrt_s,
                     Timestamp time) {
  // For a restored registration it is unknown when the bone was last found.
  const BoneFound before = level.bone_found.value_or(BoneFound{time, 0.0, drift_m_per_sqrt_s});
  level.bone_found = found_by_landmark(before, touch, *level.landmark, time);
  level.unverified = false;
  if (touch.first) {
    level.landmark->bone_sd_m = level.bone_found->sd_m;
  }
}

}  // namespace

std::optional<Event> Landmarking::touch_landmark(SessionState& work, GuideChecks& guide,
                                                 Timestamp time) {
  LevelState& level = work.level();
  const TouchedPlace place = take_place(work, time);
  if (const auto guide_tip = guide_tip_in_landmark(work, place)) {
    guide.compare_tips(work, *guide_tip, place_in_world(level), time);
    return std::nullopt;
  }
  const auto taken = take(level, place, work.tools.reference_posts(), work.anchored(), time);
  if (const auto* refusal = std::get_if<TouchRefusal>(&taken)) {
    work.messages.say(TouchNotRecorded{TouchNotRecorded::What::kLandmark, *refusal}, time);
    return std::nullopt;
  }
  const auto& touch = std::get<LandmarkTouch>(taken);
  if (touch.held()) {
    note_bone_found(level, touch, work.options.map_drift_m_per_sqrt_s, time);
  }
  if (touch.missing == 0) {
    work.observer->landmark_touched(time, level, touch);
  }
  return touch.moved() ? std::optional(Event::kLandmarkMoved) : std::nullopt;
}

/// Once the pointer was at the landmark, the guide may follow: a press belongs to the tool whose
/// tip is nearer to the landmark.
std::optional<nav::PressedPlace> Landmarking::guide_tip_in_landmark(
    SessionState& work, const TouchedPlace& pointer) const {
  constexpr double kInReach_m = 0.02;
  if (!work.options.steps.tips) {
    return std::nullopt;
  }
  const TouchedPlace guide =
      work.touches.guide.take_place(std::nullopt, work.options.max_touch_spread_m);
  const auto* guide_tip = std::get_if<nav::PressedPlace>(&guide);
  if (!guide_tip || !touched()) {
    return std::nullopt;
  }
  const Point<World> landmark = place_in_world(work.level()).place;
  const double guide_m = (guide_tip->place - landmark).norm();
  const auto* pointer_tip = std::get_if<nav::PressedPlace>(&pointer);
  const bool nearer = !pointer_tip || guide_m < (pointer_tip->place - landmark).norm();
  return nearer && guide_m <= kInReach_m ? std::optional(*guide_tip) : std::nullopt;
}

nav::PressedPlace Landmarking::place_in_world(const LevelState& level) const {
  return {level.registration->world_from_vertebra * mean_place(), sd_m()};
}

std::optional<TouchRefusal> Landmarking::too_near(const LevelState& level, Point<World> place,
                                                  std::span<const ReferencePost> posts) const {
  const double here_m = nearest_m(place, posts);
  if (here_m >= kLandmarkFromReference_m) {
    return std::nullopt;
  }
  const double limit_m =
      std::min(kLandmarkFromReference_m, kLandmarkReach * farthest_m(level, posts));
  if (here_m >= limit_m) {
    return std::nullopt;
  }
  return TouchRefusal{TouchRefusal::Kind::kTooNear, here_m, limit_m};
}

std::optional<TouchRefusal> Landmarking::refusal_of(const LevelState& level,
                                                    const nav::PressedPlace& place,
                                                    Point<Vertebra> here,
                                                    std::span<const ReferencePost> posts,
                                                    bool anchored) {
  if (touches_ > 0) {
    const double apart_m = (here - mean_place()).norm();
    const double sd_m = std::max(place.sd_m, std::sqrt(variances_m2_ / touches_));
    const double limit_m = landmark_apart_m(sd_m, anchored);
    if (!(apart_m <= limit_m)) {
      return TouchRefusal{TouchRefusal::Kind::kTouchesApart, apart_m, limit_m};
    }
  }
  return level.landmark ? std::nullopt : too_near(level, place.place, posts);
}

std::variant<LandmarkTouch, TouchRefusal> Landmarking::take(LevelState& level,
                                                            const TouchedPlace& place,
                                                            std::span<const ReferencePost> posts,
                                                            bool anchored, Timestamp time) {
  const auto* pressed = std::get_if<nav::PressedPlace>(&place);
  if (!pressed) {
    return std::get<TouchRefusal>(place);
  }
  const Point<Vertebra> here = level.registration->world_from_vertebra.inverse() * pressed->place;
  if (last_ && last_->missing == 0) {
    forget_touches();
  }
  if (const auto refusal = refusal_of(level, *pressed, here, posts, anchored)) {
    forget_touches();
    return *refusal;
  }
  sum_m_ += here.v;
  variances_m2_ += pressed->sd_m * pressed->sd_m;
  ++touches_;
  const double recorded_sd_m = level.landmark ? level.landmark->sd_m : sd_m();
  const double distance_sd_m = landmark_distance_sd_m(recorded_sd_m, sd_m(), anchored);
  last_ = LandmarkTouch{!level.landmark, std::max(0, landmark_touches(anchored) - touches_), 0.0,
                        landmark_limit_m(distance_sd_m), distance_sd_m};
  if (last_->missing > 0) {
    return *last_;
  }
  if (level.landmark) {
    last_->off_m = (mean_place() - level.landmark->in_vertebra).norm();
  } else {
    level.landmark = Landmark{mean_place(), sd_m(), time};
    recorded_here_ = true;
  }
  return *last_;
}

void Landmarking::forget_touches() {
  last_.reset();
  sum_m_ = {};
  variances_m2_ = 0.0;
  touches_ = 0;
}

void Landmarking::drop_landmark(SessionState& work, Timestamp time) {
  if (!last_) {
    return work.messages.say(NothingToDelete{NothingToDelete::What::kLandmark}, time);
  }
  const bool place = last_->missing == 0;
  if (recorded_here_) {
    work.level().landmark.reset();
  }
  recorded_here_ = false;
  forget_touches();
  if (place) {
    work.observer->landmark_dropped(time, work.level());
  }
}

void Landmarking::verify_again(SessionState& work, Verifying& verifying, Guiding& guiding,
                               Timestamp time) const {
  LevelState& level = work.level();
  level.accepted = false;
  verifying.begin_again(level, last_->off_m);
  guiding.forget_guidance();
  work.observer->acceptance_withdrawn(time, level);
  work.messages.say(LandmarkMoved{last_->off_m, last_->limit_m, work.anchored()}, time);
}

StepState Landmarking::state(const SessionState& work, const GuideChecks& guide) const {
  const LevelState& level = work.level();
  if (!level.registration) {
    return {};
  }
  if (!work.options.steps.touches_landmark()) {
    return ByEye{};
  }
  return LandmarkSoFar{level.landmark.has_value(), last_, &guide.tips(), &guide.axis()};
}

// Its records.

void log_landmark_touch(LogJson& json, const LevelState& level, const LandmarkTouch& touch) {
  json["first"] = touch.first;
  json["off_m"] = touch.off_m;
  json["limit_m"] = touch.limit_m;
  if (touch.first) {
    const Landmark& landmark = *level.landmark;
    json["landmark"] = {{"in_vertebra_m", json_of(landmark.in_vertebra.v)},
                        {"sd_m", landmark.sd_m},
                        {"bone_sd_m", landmark.bone_sd_m}};
  }
}

LandmarkTouch read_landmark_touch(const JsonNode& node, LevelState& level) {
  LandmarkTouch touch;
  touch.first = node.flag_or("first", false);
  touch.off_m = node.number("off_m");
  touch.limit_m = node.number("limit_m");
  if (touch.first) {
    const JsonNode landmark = node.child("landmark");
    level.landmark = {{landmark.vec3("in_vertebra_m")},
                      landmark.number("sd_m"),
                      Timestamp{},
                      landmark.number("bone_sd_m")};
  }
  return touch;
}

void log_landmark_dropped(LogJson& json, const LevelState& level) {
  json["stays"] = level.landmark.has_value();
}

void read_landmark_dropped(const JsonNode& node, LevelState& level) {
  if (!node.flag_or("stays", false)) {
    level.landmark.reset();
  }
}

void read_acceptance_withdrawn(LevelState& level) {
  level.accepted = false;
  level.check_points.clear();
}

// Its words.

namespace {

constexpr const char* kSayAccept = translatable("say accept result to correct it");

/// The guide's tip and the pointer's: what is to be done, or how far apart they were.
void write_tips(PartedText text, const TipCheck& tips, std::string_view separator) {
  std::string& out = text.out;
  if (tips.due()) {
    text.begin(Importance::kNext, separator);
    // How it is held matters: its tip turns with it.
    out += tips.for_screw() ? translated("guide's tip, as drilling")
                            : translated("now the guide's tip");
    return;
  }
  if (!tips.last() || tips.last()->corrected || !tips.offers()) {
    return;
  }
  text.begin(Importance::kDanger, separator);
  append_printed(out, translated("guide's tip %s from the pointer's"),
                 format_mm(tips.last()->apart_m.norm()).c_str());
  text.begin(Importance::kNext, ": ");
  out += translated(kSayAccept);
}

/// The error of the guide's axis according to the last wire, if it is worth correcting.
void write_axis(PartedText text, const LandmarkSoFar& landmark, std::string_view separator) {
  if (landmark.axis == nullptr || !landmark.axis->offers() || landmark.tips->offers()) {
    return;
  }
  text.begin(Importance::kDanger, separator);
  append_printed(text.out, translated("guide's axis %.1f° off"),
                 degrees(landmark.axis->last()->off_rad));
  text.begin(Importance::kNext, ": ");
  text.out += translated(kSayAccept);
}

}  // namespace

void write_landmark(PartedText text, const LandmarkSoFar& landmark, std::string_view separator) {
  std::string& out = text.out;
  if (!landmark.last) {
    text.begin(Importance::kNext, separator);
    if (separator.empty()) {
      // Right behind the name of the step, landmark.
      out += translated(landmark.recorded ? translatable("touch it")
                                          : translatable("touch a new one"));
    } else {
      out += translated(landmark.recorded ? words::kTouchTheLandmark : words::kTouchANewLandmark);
    }
    return;
  }
  if (landmark.last->missing > 0) {
    text.begin(Importance::kNext, separator);
    out += translated("lift, then touch again");
    return;
  }
  const std::size_t end = out.size();
  if (landmark.tips != nullptr) {
    write_tips(text, *landmark.tips, separator);
    write_axis(text, landmark, out.size() == end ? separator : "; ");
  }
  if (out.size() == end) {
    text.begin(Importance::kNext, separator);
    out += translated("say go to next");
  }
}

void write(PartedText text, const LandmarkMissing& m) {
  std::string& out = text.out;
  text.begin(Importance::kNext);
  out.append(translated(words::kNotYet)).append(" ");
  out += translated(m.recorded ? words::kTouchTheLandmark : words::kTouchANewLandmark);
}

void write(PartedText text, const LandmarkMoved& m) {
  std::string& out = text.out;
  text.begin(Importance::kDanger);
  append_beside_limit(out,
                      m.anchored
                          ? translated("the reference moved %.1f mm, limit %.1f mm")
                          : translated("the patient or the map moved %.1f mm, limit %.1f mm"),
                      m.off_m * 1e3, m.limit_m * 1e3);
  text.begin(Importance::kNext, ": ");
  out += translated("check again or reject level");
}

void write(PartedText text, const BoneUnchecked& m) {
  std::string& out = text.out;
  text.begin(Importance::kDanger);
  append_printed(out, translated("bone not checked for %.0f s, the map may have drifted %s"),
                 m.for_s, format_mm(m.drift_m).c_str());
  text.begin(Importance::kNext, ": ");
  out += translated(words::kTouchTheLandmark);
}

}  // namespace orthonav::engine
