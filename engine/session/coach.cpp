#include "engine/session/coach.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orthonav::engine {
namespace {

std::size_t samples_in(std::span<const nav::Region> regions) {
  std::size_t count = 0;
  for (const nav::Region& region : regions) {
    count += region.samples.size();
  }
  return count;
}

}  // namespace

Coaching coaching_from(const nav::Registration& registration) {
  const nav::PoseSearchRegistrationOptions limits;
  Coaching coaching;
  coaching.unique = std::none_of(registration.reasons.begin(), registration.reasons.end(),
                                 [](const nav::RefusalReason& r) {
                                   return r.kind == nav::RefusalReason::Kind::kLogLikelihoodRatio;
                                 });
  const auto is_tissue = [](const nav::RefusalReason& reason) {
    return reason.kind == nav::RefusalReason::Kind::kSoftTissue;
  };
  coaching.then_touch =
      registration.provisional &&
      std::any_of(registration.reasons.begin(), registration.reasons.end(), is_tissue);
  coaching.enough = registration.accepted || coaching.then_touch;
  const double common_m = registration.common.sd_m();
  coaching.expected_m = std::hypot(registration.predicted_tre_m, std::sqrt(3.0) * common_m);
  coaching.registration_only = !(common_m > 0.0);
  coaching.stroke_next = registration.stroke_next;
  if (coaching.unique) {
    coaching.progress = std::min(1.0, limits.max_tre_99_m / registration.tre_99_m);
    if (registration.stroke_next) {
      coaching.stroke_at = registration.world_from_vertebra * registration.stroke_next_at;
    }
  }
  // A small expected error does not help if there is another reason against the registration.
  if (coaching.unique && !coaching.enough && registration.tre_99_m <= limits.max_tre_99_m &&
      !registration.reasons.empty()) {
    coaching.against = registration.reasons.front();
  }
  return coaching;
}

void Coach::watch(WorkWatch* watch) {
  watch_ = watch;
  told_begun_ = watch_ != nullptr && under_way_ && !worker_.idle();
  if (told_begun_) {
    watch_->begins_beside(Part::kCoach);
  }
}

void Coach::look(bool waits) {
  waits_ = waits;
  if (!under_way_ || !worker_.idle()) {
    return;
  }
  if (awaited_) {
    tell_ended();
  } else {
    wait();
  }
}

void Coach::step(const OperatedLevel& level, std::span<const nav::Region> regions) {
  pairs_left_ -= pairs_left_ > 0 ? 1 : 0;
  if (awaited_ && pairs_left_ == 0 && (waits_ || worker_.idle())) {
    wait();
    awaited_ = false;
    newest_ = std::move(answer_);
  }
  const std::size_t samples = samples_in(regions);
  if (samples < kFewestSamples) {
    // The last answer may be about strokes that have since been deleted.
    newest_.reset();
    asked_samples_ = 0;
  } else if (!awaited_ && (samples < asked_samples_ || samples >= asked_samples_ + kNewSamples) &&
             is_free()) {
    asked_samples_ = samples;
    start(level, regions);
  }
}

void Coach::forget() {
  awaited_ = false;
  pairs_left_ = 0;
  if (under_way_ && waits_) {
    wait();
  }
  asked_samples_ = 0;
  newest_.reset();
}

bool Coach::is_free() {
  if (under_way_ && worker_.idle()) {
    wait();
  }
  return !under_way_;
}

void Coach::start(const OperatedLevel& level, std::span<const nav::Region> regions) {
  model_ = level.model;
  screws_ = level.screws;
  points_.clear();
  times_.clear();
  for (const nav::Region& region : regions) {
    for (const nav::Sample& sample : region.samples) {
      points_.push_back(sample.tip_in_world);
      times_.push_back(sample.time);
    }
  }
  awaited_ = under_way_ = true;
  pairs_left_ = kPairsToAnswer;
  told_begun_ = watch_ != nullptr;
  if (watch_) {
    watch_->begins_beside(Part::kCoach);
  }
  worker_.start([](void* coach) { static_cast<Coach*>(coach)->run(); }, this);
}

/// For the trial under way, whose exception is rethrown here.
void Coach::wait() {
  const Working working(watch_, Part::kCoach);
  under_way_ = false;
  worker_.wait();
  tell_ended();
}

void Coach::tell_ended() {
  if (std::exchange(told_begun_, false) && watch_) {
    watch_->ends_beside(Part::kCoach);
  }
}

void Coach::run() {
  // Whether another level fits better is checked for a real registration, not on partial strokes.
  const auto result = registrar_({*model_, points_, screws_, {}, common_, {}, times_});
  answer_ = result ? std::optional(coaching_from(*result)) : std::nullopt;
}

}  // namespace orthonav::engine
