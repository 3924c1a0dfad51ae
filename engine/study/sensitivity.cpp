#include "engine/study/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "base/random.h"
#include "engine/study/system_table.h"
#include "nav/evaluation/errors.h"

namespace orthonav::engine {
namespace {

/// Four levels of each range; a step is two thirds of it (Morris 1991).
constexpr int kLevels = 4;
constexpr double kMorrisStep = 2.0 / 3.0;

struct MeanErrors {
  double entry_mm = 0.0;
  double angle_deg = 0.0;
};

struct Effects {
  std::vector<double> entry_mm;
  std::vector<double> angle_deg;
};

/// The mean errors of a screw at a point of the ranges; nothing if no operation got as far as a
/// screw.
Result<std::optional<MeanErrors>> errors_at(const Case& source, const SensitivityOptions& options,
                                            const std::vector<const sim::Magnitude*>& magnitudes,
                                            const std::vector<double>& place) {
  StudyOptions study;
  study.operation = options.operation;
  study.runs = options.runs;
  study.first_seed = options.seed;
  study.jobs = options.jobs;
  for (std::size_t i = 0; i < magnitudes.size(); ++i) {
    const sim::Magnitude& m = *magnitudes[i];
    study.operation.sim.error_model.*m.value = m.low + place[i] * (m.high - m.low);
  }
  const auto made = run_study({&source, 1}, study);
  if (!made) {
    return made.error();
  }
  const nlohmann::json found = nlohmann::json::parse(made->text, nullptr, false);
  const auto entry = mean_over(found, "entry_error_mm", true);
  const auto angle = mean_over(found, "angle_error_deg", true);
  if (!entry || !angle) {
    return std::optional<MeanErrors>();
  }
  return std::optional(MeanErrors{entry->mean, angle->mean});
}

std::vector<double> first_place(Random& random, std::size_t count) {
  std::vector<double> place(count);
  for (double& value : place) {
    // The lower levels, from which a step stays within the range.
    value = std::floor(random.uniform() * kLevels / 2) / (kLevels - 1);
  }
  return place;
}

std::vector<std::size_t> shuffled(Random& random, std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) {
    std::swap(order[i - 1],
              order[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  }
  return order;
}

/// The mean of the absolute effects.
double mean_size(std::vector<double> effects) {
  for (double& effect : effects) {
    effect = std::abs(effect);
  }
  return nav::summarize(effects).mean;
}

/// The magnitudes with the largest effect on entry and angle first.
std::vector<Sensitivity> ranked(const std::vector<const sim::Magnitude*>& magnitudes,
                                const std::vector<Effects>& effects) {
  std::vector<Sensitivity> out;
  for (std::size_t i = 0; i < magnitudes.size(); ++i) {
    const sim::Magnitude& m = *magnitudes[i];
    out.push_back({std::string(m.name), std::string(m.unit), m.low, m.high,
                   mean_size(effects[i].entry_mm), mean_size(effects[i].angle_deg),
                   nav::summarize(effects[i].entry_mm).sd,
                   nav::summarize(effects[i].angle_deg).sd});
  }
  sort_by_effect(out);
  return out;
}

}  // namespace

void sort_by_effect(std::vector<Sensitivity>& found) {
  std::stable_sort(found.begin(), found.end(), [](const Sensitivity& a, const Sensitivity& b) {
    return std::abs(a.entry_mm) + std::abs(a.angle_deg) >
           std::abs(b.entry_mm) + std::abs(b.angle_deg);
  });
}

std::vector<const sim::Magnitude*> studied_magnitudes(const sim::ErrorModel& own) {
  const sim::ErrorModel usual;
  std::vector<const sim::Magnitude*> out;
  for (const sim::Magnitude& magnitude : sim::magnitudes()) {
    const bool decided = own.*magnitude.value != usual.*magnitude.value;
    if (magnitude.high > magnitude.low && !decided) {
      out.push_back(&magnitude);
    }
  }
  return out;
}

Result<std::vector<Sensitivity>> sensitivities(const Case& source,
                                               const SensitivityOptions& options,
                                               const std::function<void(int, int)>& progress) {
  const auto magnitudes = studied_magnitudes(options.operation.sim.error_model);
  std::vector<Effects> effects(magnitudes.size());
  Random random = Random(options.seed).fork("sensitivities");
  int done = 0;
  const int all = options.trajectories * (static_cast<int>(magnitudes.size()) + 1);
  const auto at = [&](const std::vector<double>& place) {
    auto errors = errors_at(source, options, magnitudes, place);
    ++done;
    if (progress) {
      progress(done, all);
    }
    return errors;
  };
  for (int t = 0; t < options.trajectories; ++t) {
    std::vector<double> place = first_place(random, magnitudes.size());
    auto before = at(place);
    for (const std::size_t i : shuffled(random, magnitudes.size())) {
      place[i] += kMorrisStep;
      auto after = at(place);
      if (!after) {
        return after.error();
      }
      if (before && *before && *after) {
        effects[i].entry_mm.push_back(((*after)->entry_mm - (*before)->entry_mm) / kMorrisStep);
        effects[i].angle_deg.push_back(((*after)->angle_deg - (*before)->angle_deg) / kMorrisStep);
      }
      before = std::move(after);
    }
  }
  return ranked(magnitudes, effects);
}

std::string sensitivity_table(const std::vector<Sensitivity>& found,
                              const SensitivityOptions& options) {
  const std::string how =
      options.points > 0 ? "95 % interval, regressed over " + std::to_string(options.points) +
                               " operations at random places of all ranges"
                         : "SD over " + std::to_string(options.trajectories) + " trajectories, " +
                               std::to_string(options.runs) + " operations at each point";
  std::string out = "Mean change of a screw's error over the range, ± " + how +
                    ".\n\n"
                    "| magnitude | range | entry, mm | angle, ° |\n|---|---|---|---|\n";
  for (const Sensitivity& s : found) {
    char line[200];
    std::snprintf(line, sizeof line, "| `%s` | %g to %g %s | %.2f ± %.2f | %.2f ± %.2f |\n",
                  s.magnitude.c_str(), s.low, s.high, s.unit.c_str(), s.entry_mm, s.entry_spread_mm,
                  s.angle_deg, s.angle_spread_deg);
    out += line;
  }
  return out;
}

}  // namespace orthonav::engine
