#include "study/surgeon/scripted_surgeon.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "study/surgeon/written_frame.h"

namespace orthonav::sim {
namespace {

/// A frame older than this is no longer in view: the display has gone dark.
constexpr double kDark_s = 0.15;
/// Holograms farther than this from the real bone are rejected.
constexpr double kAcceptedOverlay_m = 0.006;
/// Comparing model and bone takes a second or two of glances.
constexpr double kComparing_s = 1.5;
constexpr double kGlance_s = 0.1;

/// Factor on all durations relative to the median surgeon; its mean over surgeons is 1 / pace.
double slowness_of(const ErrorModel& error_model, Random random) {
  const double sd = error_model.pace_sd;
  return std::exp(sd * random.normal() - 0.5 * sd * sd) / error_model.pace;
}

/// How high this surgeon glides over the bone, relative to the mean of surgeons.
double lightness_of(const ErrorModel& error_model, Random random) {
  return std::max(0.0, 1.0 + error_model.stroke_lift_sd * random.normal());
}

Posture standing_at(const RoomLayout& layout) {
  Posture posture;
  posture.head.gaze = layout.middle();
  return posture;
}

/// Whether a surgeon who looks from behind can see a place on the bone itself, with no bone above
/// it. A hologram also shows places hidden behind the bone, but they can't be compared.
bool is_visible(const BoneSurface& bone, Vec3 place) {
  constexpr double kFrom_m = 0.1;
  constexpr double kSame_m = 0.003;
  constexpr Vec3 kPosterior{0, 1, 0};
  const auto hit = bone.first_hit(place + kFrom_m * kPosterior, -kPosterior, 2.0 * kFrom_m);
  return hit && (hit->point - place).norm() < kSame_m;
}

/// The four places that H2 marks, on the bone: the most posterior, left, right and superior
/// vertices.
std::array<Vec3, 4> landmarks(const RoomLevel& level) {
  const auto extremes = level.extremes.value_or(extremes_of(level));
  std::array<Vec3, 4> found;
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i] = level.vertices_m[extremes[i]];
  }
  return found;
}

/// How far a shown bone lies from the real one at its landmarks, averaged over glances.
struct OverlayComparison {
  std::array<Vec3, 4> in_vertebra_m;
  std::array<bool, 4> visible;
  std::array<Vec3, 4> apart_m{};

  OverlayComparison(const RoomLevel& level, const BoneSurface& surface)
      : in_vertebra_m(landmarks(level)) {
    for (std::size_t i = 0; i < visible.size(); ++i) {
      visible[i] = is_visible(surface, in_vertebra_m[i]);
    }
  }
  void glance(const Transform<Room, Vertebra>& room_from_vertebra, const Eyes& eyes,
              const ShownHologram& model) {
    for (std::size_t i = 0; i < in_vertebra_m.size(); ++i) {
      const Point<Room> bone = room_from_vertebra * Point<Vertebra>{in_vertebra_m[i]};
      apart_m[i] += (kGlance_s / kComparing_s) * (eyes.place(model.points_in_world[i]) - bone);
    }
  }
  [[nodiscard]] bool fits(Vec3 perceived_offset_m) const {
    for (std::size_t i = 0; i < visible.size(); ++i) {
      // Negated, so that NaN does not fit.
      if (visible[i] && !((apart_m[i] + perceived_offset_m).norm() <= kAcceptedOverlay_m)) {
        return false;
      }
    }
    return true;
  }
};

}  // namespace

ScriptedSurgeon::ScriptedSurgeon(const Workplace& workplace)
    : layout_(&workplace.layout),
      error_model_(&workplace.error_model),
      metal_(workplace.metal),
      body_(workplace.random.fork("hand"), *error_model_,
            slowness_of(*error_model_, workplace.random.fork("pace")), standing_at(*layout_)),
      guidance_(workplace.guidance),
      relies_on_reference_(workplace.relies_on_reference),
      checking_(workplace.random.fork("checking")),
      seating_(workplace.random.fork("seating")),
      sleeving_(workplace.random.fork("sleeving")),
      lightness_(lightness_of(*error_model_, workplace.random.fork("lightness"))),
      regions_(layout_->levels()),
      failures_(layout_->levels()),
      landmarks_(layout_->levels()),
      moved_(layout_->levels()),
      life_(operate()) {
  const RoomLayout& layout = *layout_;
  if (!layout.operated().empty()) {
    body_.posture().level = layout.operated().front();
  }
  const Random tissue = workplace.random.fork("tissue");
  const bool strokes = layout.room().screws.empty();
  for (const std::size_t level : strokes ? layout.operated() : std::vector<std::size_t>()) {
    regions_[level] = plan_strokes(layout.room().levels[level], layout.room().exposure);
    cover_with_tissue(regions_[level], error_model_->tissue_m, tissue.fork(level));
  }
  life_.start();
}

void ScriptedSurgeon::see(const WornFrame& frame, const Transform<Room, World>& room_from_world) {
  if (auto shown = shown_in(frame)) {
    eyes_.see(*std::move(shown), room_from_world);
  }
}

void ScriptedSurgeon::tick(Timestamp now, const Bearings& bearings) {
  bearings_ = bearings;
  if (const auto level = eyes_.status() ? layout_->find(step_now().level) : std::nullopt) {
    body_.posture().level = *level;
  }
  body_.tick(now);
}

bool ScriptedSurgeon::sees_now() const {
  const auto seen = eyes_.seen_at();
  return seen && seconds(body_.now() - *seen) < kDark_s;
}

void ScriptedSurgeon::give_up() {
  gave_up_ = true;
  finished_ = true;
}

Script ScriptedSurgeon::operate() {
  co_await body_.next_tick();
  while (!finished_) {
    if (eyes_.status()) {
      co_await perform(step_now());
    } else {
      co_await await_change(std::nullopt, "");
    }
  }
  for (;;) {
    co_await body_.next_tick();
  }
}

Script ScriptedSurgeon::perform(StepOnDisplay step) {
  const auto level = layout_->find(step.level);
  if (step.step == Step::kSetup) {
    co_await set_up();
    co_await await_change(step, words().begin);
  } else if (step.step == Step::kDigitize && level) {
    co_await digitize(*level);
    co_await await_verdict(*level, step);
  } else if (step.step == Step::kVerify && level) {
    co_await verify(*level);
  } else if (step.step == Step::kTouchLandmark && level) {
    co_await body_.rest(1.0);
    if (asked(ChecksAsked::kTouchMore)) {
      co_await touch_landmark(*level);
    }
    if (in_step(step) && asked(ChecksAsked::kGuideTip)) {
      co_await compare_tips(*level);
    } else if (in_step(step) && asked(ChecksAsked::kGuideTipHeld)) {
      co_await compare_tips_as_for_screw(*level);
    }
    co_await consent_to_corrections(step);
    if (in_step(step)) {
      body_.say(words().next);
      co_await await_change(step, words().next);
    }
  } else if (step.step == Step::kGuide && level && step.side) {
    co_await guide(*level, *step.side);
    if (driven_.contains(step)) {
      co_await await_change(step, words().next);
    }
  } else if (step.step == Step::kMeasureWire && level && step.side) {
    co_await look_at_wire(*level, *step.side);
  } else if (step.step == Step::kRod && step.side) {
    co_await touch_heads(*step.side);
    co_await await_change(step, words().finish_rod);
  } else if (step.step == Step::kDone) {
    finished_ = true;
  } else {
    co_await await_change(step, "");
  }
}

Script ScriptedSurgeon::set_up() {
  const auto& operated = layout_->operated();
  const Point<Room> site = operated.empty() ? layout_->middle() : layout_->site(operated.front());
  co_await body_.take(ToolKind::kPointer, site);
  co_await body_.rest(1.0);
  body_.say(words().begin);
}

Script ScriptedSurgeon::await_change(std::optional<StepOnDisplay> step, std::string phrase) {
  for (int repeat = 0; repeat <= kRepeats; ++repeat) {
    const Timestamp end = body_.now() + from_seconds(kPatience_s);
    while (body_.now() < end) {
      if (step ? !in_step(*step) : eyes_.status().has_value()) {
        co_return;
      }
      co_await body_.next_tick();
    }
    if (repeat < kRepeats && !phrase.empty()) {
      body_.say(phrase);
    }
  }
  give_up();
}

Script ScriptedSurgeon::verify(std::size_t level) {
  const StepOnDisplay step = step_now();
  body_.posture().contact_normal.reset();
  // Once may be due to the touch; twice means that it has moved.
  bool fits = !(told(Notice::kLandmarkMoved) && ++moved_[level] > 1);
  co_await body_.rest(1.0);
  bool asked_to_touch = asked(ChecksAsked::kTouchMore);
  if (fits && asked_to_touch) {
    // Touches may still move the displayed bone.
    co_await check_by_touch(level, fits);
  }
  if (fits && in_step(step)) {
    co_await compare_overlay(level, fits, asked_to_touch);
  }
  if (fits && asked_to_touch && in_step(step)) {
    // In case the line showed something else at first.
    co_await check_by_touch(level, fits);
  }
  if (!in_step(step) || finished_) {
    co_return;
  }
  body_.say(fits ? words().accept : words().reject);
  moved_[level] = fits ? moved_[level] : 0;
  if (!fits && ++failures_[level] >= kMaxFailures) {
    give_up();
  }
  if (!finished_) {
    co_await await_change(step, fits ? words().accept : words().reject);
  }
}

Script ScriptedSurgeon::compare_overlay(std::size_t level, bool& fits, bool& asked_to_touch) {
  const StepOnDisplay step = step_now();
  OverlayComparison overlay(layout_->room().levels[level], layout_->bone(level));
  const Timestamp patience = body_.now() + from_seconds(kPatience_s * kRepeats);
  for (double looked_s = 0.0; looked_s < kComparing_s; looked_s += kGlance_s) {
    co_await body_.rest(kGlance_s / body_.slowness());
    const ShownHologram* model = eyes_.find(HologramKind::kVertebra);
    while (!(model && sees_now() && model->points_in_world.size() == overlay.apart_m.size())) {
      if (body_.now() > patience) {
        give_up();
      }
      if (!in_step(step) || finished_) {
        co_return;
      }
      co_await body_.next_tick();
      model = eyes_.find(HologramKind::kVertebra);
    }
    asked_to_touch = asked_to_touch || asked(ChecksAsked::kTouchMore);
    const auto& at_rest = layout_->room_from_vertebra(level);
    overlay.glance({at_rest.rotation(), at_rest.translation() + moved_m()}, eyes_, *model);
  }
  fits = overlay.fits(misperceived(layout_->site(level), error_model_->overlay_comparison_m));
}

}  // namespace orthonav::sim
