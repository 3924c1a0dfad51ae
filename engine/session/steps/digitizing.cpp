#include "engine/session/steps/digitizing.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/printed.h"
#include "base/reason.h"
#include "base/translation.h"
#include "engine/io/bit_hash.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine {

void Registering::watch(WorkWatch* watch) {
  watch_ = watch;
  if (watch_ && under_way_) {
    watch_->begins_beside(Part::kRegistration);
  }
}

RegistrationJob Registering::now(RegistrationJob job) const {
  const auto register_from = [&](std::size_t first) {
    return registrar_({*job.level.model, std::span(job.points).subspan(first), job.level.screws,
                       job.level.neighbours, job.common, std::span(job.shafts).subspan(first),
                       std::span(job.times).subspan(first)});
  };
  const auto passes = [](const Result<nav::Registration>& found) {
    return found && (found->accepted || found->provisional);
  };
  job.found = register_from(0);
  if (job.refused > 0 && job.refused < job.points.size() && !passes(*job.found)) {
    Result<nav::Registration> alone = register_from(job.refused);
    if (passes(alone)) {
      job.found = std::move(alone);
      job.left_out = job.refused;
    }
  }
  return job;
}

void Registering::begin(RegistrationJob job) {
  asked_ = std::move(job);
  if (!under_way_) {
    start();
  }
}

void Registering::forget() {
  asked_.reset();
  wanted_ = false;
}

std::optional<RegistrationJob> Registering::answer() {
  if (!under_way_ || !worker_->idle()) {
    return std::nullopt;
  }
  under_way_ = false;
  {
    const Working working(watch_, Part::kRegistration);
    worker_->wait();
  }
  if (watch_) {
    watch_->ends_beside(Part::kRegistration);
  }
  if (asked_) {
    start();
    return std::nullopt;
  }
  return std::exchange(wanted_, false) ? std::optional(std::move(job_)) : std::nullopt;
}

void Registering::start() {
  if (!worker_) {
    worker_ = std::make_unique<nav::Worker>();
  }
  job_ = *std::exchange(asked_, std::nullopt);
  wanted_ = under_way_ = true;
  if (watch_) {
    watch_->begins_beside(Part::kRegistration);
  }
  worker_->start(
      [](void* raw) {
        auto& self = *static_cast<Registering*>(raw);
        self.job_ = self.now(std::move(self.job_));
      },
      this);
}

namespace {

/// A saved region is deleted when "delete" is said twice within this time.
constexpr Duration kSaidTwiceWithin = std::chrono::seconds(5);

std::ptrdiff_t saved_in(std::span<const nav::Region> regions) {
  return std::count_if(regions.begin(), regions.end(),
                       [](const nav::Region& region) { return region.saved; });
}

/// Requires a saved region.
const nav::Region& last_saved(std::span<const nav::Region> regions) {
  return *std::find_if(regions.rbegin(), regions.rend(),
                       [](const nav::Region& region) { return region.saved; });
}

/// Why a registration does not count, with what to do about it, if that is known.
Message message_about(const RegistrationOutcome& outcome) {
  RegistrationRefused refused;
  refused.error = outcome.error;
  if (outcome.result) {
    refused.reasons = outcome.result->reasons;
    refused.stroke_next = outcome.result->stroke_next;
    refused.another_level_fits = !outcome.result->fits_better.empty();
  }
  return refused;
}

}  // namespace

Digitizing::Digitizing(const SessionState& work) : registering_(work.method.registrar) {
  if (work.method.coaching) {
    coach_ = std::make_unique<Coach>(work.method.registrar, work.options.common);
  }
}

void Digitizing::watch_work(WorkWatch* watch) {
  registering_.watch(watch);
  if (coach_) {
    coach_->watch(watch);
  }
}

void Digitizing::press(LevelState& level, Timestamp time) {
  strokes_.digitizer.press(time);
  if (!level.first_press) {
    level.first_press = time;
  }
}

void Digitizing::collect(const SessionState& work) {
  if (strokes_.digitizer.recording()) {
    const std::size_t pointer = work.tools.pointer();
    const nav::ToolGeometry& tool = work.tools.geometry(pointer);
    strokes_.digitizer.add(work.tools.watch(pointer).newest(), tool.tip_in_marker,
                           tool.axis_in_marker);
  }
  if (coach_) {
    coach_->step(work.level().plan, regions());
  }
}

void Digitizing::save_region(SessionState& work, Timestamp time) {
  const std::ptrdiff_t before = saved_in(regions());
  strokes_.digitizer.save();
  if (saved_in(regions()) > before) {
    // If the button is still down, the next region has already begun after it.
    work.observer->region_saved(time, work.level(), last_saved(regions()));
  } else {
    work.messages.say(NotPossibleNow{Event::kSaySave}, time);
  }
}

void Digitizing::drop_region(SessionState& work, Timestamp time) {
  const std::ptrdiff_t before = saved_in(regions());
  Message answer = dropped(time);
  if (saved_in(regions()) < before) {
    work.observer->region_dropped(time, work.level());
  }
  if (!std::holds_alternative<std::monostate>(answer)) {
    work.messages.say(std::move(answer), time);
  }
}

/// Returns what the surgeon must be told, which may be nothing.
Message Digitizing::dropped(Timestamp time) {
  std::optional<nav::Region> gone = strokes_.digitizer.drop();
  const bool asked =
      std::exchange(strokes_.asked_to_drop_saved, std::nullopt) >= time - kSaidTwiceWithin;
  if (!gone && asked) {
    gone = strokes_.digitizer.drop_saved();
  }
  if (gone) {
    // It fades instead of vanishing.
    strokes_.dropped = {std::move(*gone), time};
    return {};
  }
  // One word too many must not cost a good region.
  if (saved_in(regions()) == 0) {
    return NothingToDelete{NothingToDelete::What::kRegion};
  }
  strokes_.asked_to_drop_saved = time;
  return ConfirmDelete{last_saved(regions()).samples.size()};
}

std::optional<Event> Digitizing::register_level(SessionState& work, Timestamp time) {
  LevelState& level = work.level();
  const WatchedTools& tools = work.tools;
  level.tag_size.reset();
  if (const auto fraction = tools.tag_size_off(tools.pointer())) {
    level.tag_size = TagSizeWarning{tools.geometry(tools.pointer()).name, *fraction};
  }
  nav::Digitizer& digitizer = strokes_.digitizer;
  digitizer.release(time);
  // Unsaved samples are not registered: the two clicks that ask for the registration are not
  // strokes.
  digitizer.drop();
  // The trial under way is no longer needed, and would take processor time from this registration.
  forget_work();
  nav::CommonErrors common = work.options.common;
  common.map_m =
      std::hypot(common.map_m, work.options.drift_since_m(time - level.first_press.value_or(time)));
  RegistrationJob job{level.plan,
                      digitizer.saved_points(),
                      digitizer.saved_shafts(),
                      digitizer.saved_times(),
                      common,
                      time};
  if (level.newest && work.method.verification == Verification::kByTouch) {
    const std::vector<Point<World>>& before = level.newest->points;
    job.refused =
        static_cast<std::size_t>(std::ranges::mismatch(before, job.points).in1 - before.begin());
  }
  if (work.waits) {
    return take(work, registering_.now(std::move(job)), time);
  }
  registering_.begin(std::move(job));
  return std::nullopt;
}

std::optional<Event> Digitizing::look(SessionState& work, Timestamp time) {
  if (coach_) {
    coach_->look(work.waits);
  }
  auto job = registering_.answer();
  return job ? std::optional(take(work, std::move(*job), time)) : std::nullopt;
}

Event Digitizing::take(SessionState& work, RegistrationJob job, Timestamp time) {
  LevelState& level = work.level();
  const Result<nav::Registration>& result = *job.found;
  RegistrationOutcome outcome;
  ++level.attempts;
  level.newest.reset();
  if (!result) {
    outcome.error = result.error();
  } else {
    outcome.result = *result;
    outcome.provisional = result->provisional && work.method.verification == Verification::kByTouch;
    const auto first = job.points.begin() + static_cast<std::ptrdiff_t>(job.left_out);
    level.newest = RegistrationAttempt{{first, job.points.end()}, *result, job.left_out};
  }
  if (outcome.passed()) {
    level.registration = *result;
    const nav::Anchor* anchor = work.tools.tracker().anchor();
    level.registered_on_map = anchor ? std::optional(anchor->world_from_anchored) : std::nullopt;
    level.predicted = nav::predicted_errors(*result, level.plan.screws);
    level.digitization_s = level.first_press ? seconds(job.asked - *level.first_press) : 0.0;
  } else {
    work.messages.say(message_about(outcome), time);
    if (result && coach_) {
      coach_->tell(coaching_from(*result), strokes_.digitizer.saved_count());
    }
  }
  work.observer->registered(time, level, outcome);
  return outcome.passed() ? Event::kRegistered : Event::kRegistrationRefused;
}

void Digitizing::clear() {
  forget_work();
  // A region that was deleted a moment ago still fades.
  strokes_.digitizer = nav::Digitizer{};
}

void Digitizing::forget_map() {
  forget_work();
  strokes_ = Strokes{};
}

void Digitizing::forget_work() {
  registering_.forget();
  if (coach_) {
    coach_->forget();
  }
}

void Digitizing::write(Guidance& out) const {
  const DroppedRegion& dropped = strokes_.dropped;
  const bool fading =
      !dropped.region.samples.empty() && out.display_time - dropped.dropped_at <= out.fade;
  out.regions = regions();
  out.dropped = fading ? &dropped : nullptr;
}

StrokesSoFar Digitizing::state() const {
  StrokesSoFar strokes;
  for (const nav::Region& region : regions()) {
    strokes.points += region.samples.size();
  }
  strokes.coaching = coach_ && coach_->newest() ? &*coach_->newest() : nullptr;
  return strokes;
}

// Its records.

namespace {

LogJson region_json(const nav::Region& region) {
  LogJson tips = LogJson::array();
  LogJson shafts = LogJson::array();
  LogJson sds = LogJson::array();
  for (const nav::Sample& sample : region.samples) {
    const Vec3 tip_m = sample.tip_in_world.v;
    tips.insert(tips.end(), {tip_m.x, tip_m.y, tip_m.z});
    const Vec3 shaft = sample.shaft_in_world;
    shafts.insert(shafts.end(), {shaft.x, shaft.y, shaft.z});
    sds.push_back(sample.tip_sd_m);
  }
  return {{"samples", region.samples.size()},
          {"tips_in_world_m", std::move(tips)},
          {"shafts_in_world", std::move(shafts)},
          {"tip_sds_m", std::move(sds)}};
}

}  // namespace

nav::Region region_from(const JsonNode& node) {
  nav::Region region;
  region.saved = true;
  const std::size_t samples = count_from(node, "samples");
  if (samples > kMostSamples) {
    node.refuse("samples", "must be at most 1000000");
    return region;
  }
  const std::vector<double> tips_m = node.numbers("tips_in_world_m", 3 * samples);
  const std::vector<double> shafts = node.numbers("shafts_in_world", 3 * samples);
  const std::vector<double> sds_m = node.numbers("tip_sds_m", samples);
  if (tips_m.size() != 3 * samples || shafts.size() != 3 * samples || sds_m.size() != samples) {
    return region;
  }
  for (std::size_t i = 0; i < samples; ++i) {
    region.samples.push_back({{{tips_m[3 * i], tips_m[3 * i + 1], tips_m[3 * i + 2]}},
                              Timestamp{},
                              {shafts[3 * i], shafts[3 * i + 1], shafts[3 * i + 2]},
                              sds_m[i]});
  }
  return region;
}

std::string hash_of(std::span<const Point<World>> points) {
  BitHash hash;
  for (const Point<World>& point : points) {
    hash.add(point.v);
  }
  return hash.text();
}

namespace {

std::vector<Point<World>> points_of(const std::vector<nav::Region>& strokes) {
  std::vector<Point<World>> points;
  for (const nav::Region& region : strokes) {
    for (const nav::Sample& sample : region.samples) {
      points.push_back(sample.tip_in_world);
    }
  }
  return points;
}

}  // namespace

void log_region(LogJson& json, const nav::Region& region) { json["region"] = region_json(region); }

void read_region(const JsonNode& node, std::vector<nav::Region>& strokes) {
  strokes.push_back(region_from(node.child("region")));
}

void read_region_dropped(const JsonNode& node, std::vector<nav::Region>& strokes) {
  if (strokes.empty()) {
    node.refuse("level", "has no region to be deleted");
  } else {
    strokes.pop_back();
  }
}

void log_registration(LogJson& json, const LevelState& level, const RegistrationOutcome& outcome) {
  json["attempt"] = level.attempts;
  json["passed"] = outcome.passed();
  json["reason"] = outcome.passed() ? "" : refusal_text(outcome);
  if (const auto& result = outcome.result) {
    json["registration"] = json_of(*result);
    json["weakest"] = result->weakest ? text_of(*result->weakest) : "";
    json["advice"] = result->stroke_next ? text_of(*result->stroke_next) : "";
    json["fits_better"] = result->fits_better;
  }
  if (outcome.passed()) {
    json["points_hash"] = hash_of(level.newest->points);
    json["points_left_out"] = level.newest->left_out;
    json["digitization_s"] = level.digitization_s;
  }
  if (level.tag_size) {
    json["tag_size"] = {{"tool", level.tag_size->tool}, {"fraction", level.tag_size->fraction}};
  }
}

LoggedRegistration read_registration(const JsonNode& node, LevelState& level,
                                     const std::vector<nav::Region>& strokes) {
  LoggedRegistration asked;
  asked.attempt = level.attempts = node.integer("attempt");
  asked.passed = node.flag_or("passed", false);
  asked.reason = node.text("reason");
  level.tag_size.reset();
  if (node.has("tag_size")) {
    const JsonNode size = node.child("tag_size");
    level.tag_size = TagSizeWarning{size.text("tool"), size.number("fraction")};
  }
  asked.tag_size = level.tag_size;
  if (node.has("registration")) {
    asked.result = registration_from(node.child("registration"));
  }
  if (!asked.passed) {
    return asked;
  }
  if (!asked.result) {
    node.refuse("registration", "is missing, though it passed");
    return asked;
  }
  level.forget_registration();
  level.registration = asked.result;
  level.digitization_s = node.number("digitization_s");
  std::vector<Point<World>> points = points_of(strokes);
  const auto left_out =
      std::min(points.size(), static_cast<std::size_t>(node.unsigned_integer("points_left_out")));
  points.erase(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(left_out));
  level.newest = {std::move(points), *level.registration, left_out};
  if (hash_of(level.newest->points) != node.text("points_hash")) {
    level.newest.reset();
  }
  return asked;
}

void read_level_cleared(LevelState& level, std::vector<nav::Region>& strokes) {
  strokes.clear();
  level.newest.reset();
  level.forget_registration();
}

// Its words.

void write_coaching(PartedText text, const Coaching& coaching, std::string_view separator) {
  std::string& out = text.out;
  // A bar that fills as the expected error falls.
  constexpr int kParts = 5;
  const int filled =
      coaching.enough ? kParts : std::min(kParts - 1, static_cast<int>(kParts * coaching.progress));
  text.begin(Importance::kFigures, separator);
  for (int i = 0; i < kParts; ++i) {
    out += i < filled ? "◆" : "◇";
  }
  separator = " ";
  if (coaching.enough) {
    text.begin(Importance::kNext, separator);
    out += coaching.then_touch ? translated("double click, touch the bone")
                               : translated("enough: double click");
  } else if (coaching.against) {
    text.begin(Importance::kMessage, separator);
    append(out, *coaching.against);
  } else if (coaching.stroke_next) {
    text.begin(Importance::kNext, separator);
    append(out, *coaching.stroke_next);
  } else {
    text.begin(Importance::kNext, separator);
    out += translated("stroke on");
  }
}

void append(std::string& out, const Coaching& coaching) {
  write_coaching(PartedText{out}, coaching, "");
}

void write(PartedText text, const ConfirmDelete& m) {
  std::string& out = text.out;
  text.begin(Importance::kNext);
  if (m.points == 1) {
    out += translated("say delete last again to drop the last saved point");
    return;
  }
  append_printed(out, translated("say delete last again to drop the last saved %zu points"),
                 m.points);
}

void write(PartedText text, const RegistrationRefused& m) {
  std::string& out = text.out;
  text.begin(Importance::kMessage);
  out.append(translated("refused:")).append(" ");
  const std::span<const nav::RefusalReason> reasons = m.reasons;
  if (m.error) {
    append_error(out, *m.error);
  } else {
    append(out, reasons.first(std::min<std::size_t>(1, reasons.size())));
  }
  if (m.another_level_fits) {
    text.begin(Importance::kNext, "; ");
    out += translated("verify the vertebral level");
  } else if (m.stroke_next) {
    text.begin(Importance::kNext, "; ");
    append(out, *m.stroke_next);
  }
}

}  // namespace orthonav::engine
