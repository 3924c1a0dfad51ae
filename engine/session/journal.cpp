#include "engine/session/journal.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/session/journal_lines.h"
#include "engine/session/wording.h"

namespace orthonav::engine {
namespace {

using Json = JournalLine;

/// Row-major, translation in mm.
Json matrix_mm(std::array<double, 16> m) {
  for (const std::size_t i : {3u, 7u, 11u}) {
    m[i] *= 1e3;
  }
  return m;
}

/// The additional figures of method `best` about a registration. Unbounded values become null.
void put_judgement(Json& line, const nav::Registration& result) {
  line["noise_mm"] = result.noise_m * 1e3;
  line["inlier_share"] = result.inlier_fraction;
  line["effective_points"] = result.effective_points;
  line["coverage_share"] = result.coverage_fraction;
  line["swept_share"] = result.shaft_collision_fraction;
  line["margin"] = result.log_likelihood_ratio;
  line["expected_tre_mm"] = result.predicted_tre_m * 1e3;
  line["tre_95_mm"] = result.tre_95_m * 1e3;
  line["weakest"] = result.weakest ? text_of(*result.weakest) : "";
  line["advice"] = result.stroke_next ? text_of(*result.stroke_next) : "";
  if (!result.fits_better.empty()) {
    line["fits_better"] = result.fits_better;
  }
}

Json plan_of(const std::vector<PlannedLevel>& levels) {
  Json plan = Json::array();
  for (const PlannedLevel& level : levels) {
    plan.push_back(Json{{"label", level.label}, {"screws", Json::array()}});
    for (const nav::Side side : level.screws) {
      plan.back()["screws"].push_back(name_of(side));
    }
    for (const AcceptedBreach& breach : level.breaches) {
      plan.back()["accepted_breaches"].push_back(
          Json{{"side", name_of(breach.side)}, {"reason", breach.reason}});
    }
  }
  return plan;
}

}  // namespace

PlannedLevel planned(const std::string& label, const std::vector<nav::ScrewPlan>& screws) {
  PlannedLevel level{label, {}, {}};
  for (const nav::ScrewPlan& screw : screws) {
    level.screws.push_back(screw.side);
    if (!screw.accepted_breach.empty()) {
      level.breaches.push_back({screw.side, screw.accepted_breach});
    }
  }
  return level;
}

Result<std::unique_ptr<Journal>> Journal::create(const std::string& path,
                                                 const JournalHeader& header) {
  auto log = LineLog::create(path);
  if (!log) {
    return log.error();
  }
  Json line{{"format", "orthonav session"},
            {"format_version", 1},
            {"orthonav", header.version},
            {"device", header.device},
            {"method", header.method},
            {"case", header.case_name},
            {"seed", header.seed},
            {"patient_reference", header.patient_reference},
            {"levels", plan_of(header.levels)}};
  if (header.errors) {
    line["common_errors"] = errors_json(*header.errors);
  }
  add_line(**log, line);
  return std::unique_ptr<Journal>(new Journal(std::move(*log), header.epoch_ticks_100ns));
}

Status Journal::finish(const JournalEnd& end) {
  const Timestamp time = std::max(newest_, end.time.value_or(newest_));
  Json line = journal_line(file_ticks(time), time, "ended");
  if (!end.reason.empty()) {
    line["reason"] = end.reason;
  }
  add_line(*log_, line);
  return log_->finish();
}

void Journal::happened(Timestamp time, Step from, Event event, Cell answer) {
  newest_ = std::max(newest_, time);
  Json line = journal_line(file_ticks(time), time, "event");
  line["step"] = name_of(from);
  line["event"] = name_of(event);
  line["action"] = name_of(answer.action);
  line["next"] = name_of(answer.next);
  add_line(*log_, line, answer.action == Action::kAccept ? kDurable : LineLog::Keep::kWritten);
}

void Journal::asked_from_outside(const Request& request) {
  Json line = journal_line(file_ticks(request.time), request.time, "asked from outside");
  line["from"] = request.from;
  line["asked"] = request.text;
  add_line(*log_, line);
}

void Journal::not_understood(const Phrase& phrase) {
  Json line = journal_line(file_ticks(phrase.time), phrase.time, "not understood");
  line["phrase"] = phrase.text;
  line["confidence"] = phrase.confidence;
  add_line(*log_, line);
}

void Journal::registered(Timestamp time, const LevelState& level,
                         const RegistrationOutcome& outcome) {
  tell_registration(time, level, outcome, false);
}

void Journal::registration_restored(Timestamp time, const LevelState& level) {
  const bool provisional = !level.registration->accepted;
  tell_registration(time, level, {level.registration, std::nullopt, provisional}, true);
}

void Journal::tell_registration(Timestamp time, const LevelState& level,
                                const RegistrationOutcome& outcome, bool restored) {
  Json line = journal_line(file_ticks(time), time, "registration", level);
  line["attempt"] = level.attempts;
  line["accepted"] = outcome.passed();
  if (outcome.provisional) {
    line["provisional"] = true;
  }
  if (restored) {
    line["restored"] = true;
    line["accepted_earlier"] = level.accepted;
  }
  if (!outcome.passed()) {
    line["reason"] = refusal_text(outcome);
  }
  if (const auto& result = outcome.result) {
    line["points"] = result->points;
    line["rmse_mm"] = result->rmse_m * 1e3;
    line["runner_up_rmse_mm"] = result->runner_up_rmse_m * 1e3;
    line["world_from_vertebra_mm"] = matrix_mm(result->world_from_vertebra.row_major());
    if (result->tre_95_m > 0.0) {
      put_judgement(line, *result);
      line["registration_only"] = !(result->common.sd_m() > 0.0);
    }
  }
  if (level.tag_size) {
    std::string warning;
    append_tag_size_off(warning, level.tag_size->tool, level.tag_size->fraction);
    line["warning"] = warning;
  }
  // Infinite, that is unbounded, values become null.
  if (outcome.passed()) {
    line["predicted_tre_mm"] = nav::worst_m(level.predicted) * 1e3;
  }
  add_line(*log_, line, kDurable);
}

void Journal::accepted(Timestamp time, const LevelState& level, std::string_view /*shown*/) {
  Json line = journal_line(file_ticks(time), time, "accepted", level);
  line["check_points"] = level.check_points.size();
  line["world_from_vertebra_mm"] = matrix_mm(level.registration->world_from_vertebra.row_major());
  line["predicted_tre_mm"] = nav::worst_m(level.predicted) * 1e3;
  if (level.registration->tre_95_m > 0.0) {
    line["tre_95_mm"] = level.registration->tre_95_m * 1e3;
  }
  add_line(*log_, line, kDurable);
}

}  // namespace orthonav::engine
