#include "study/rod_experiment.h"

#include <algorithm>
#include <utility>

#include "base/check.h"
#include "base/random.h"
#include "nav/evaluation/errors.h"
#include "study/rod_bench.h"
#include "study/rod_in_hand.h"

namespace orthonav::engine {
namespace {

RodTask rod_task(const RodExperimentOptions& options, Random random) {
  RodTask task;
  task.hands = rod_log_normal(random, options.pace_sd);
  for (int i = 0; i < kMaxRodDraws; ++i) {
    const auto rod =
        nav::rod_template(options.heads_m.empty() ? drawn_lumbar_heads_m(random) : options.heads_m,
                          options.rod_diameter_m);
    if (!rod) {
      continue;
    }
    task.heads_m = rod->heads_m;
    task.to_bone = rod_screw_directions(task.heads_m, options.to_bone);
    auto cut = nav::rod_cut(*rod, task.to_bone, {options.head_to_seat_m, options.overhang_m});
    if (cut) {
      task.cut = *std::move(cut);
      return task;
    }
  }
  ORTHONAV_CHECK(false && "screw heads never gave a rod");
  return task;
}

template <class Read>
nav::Summary over_rods(const std::vector<BentRod>& rods, Read read) {
  std::vector<double> values(rods.size());
  std::transform(rods.begin(), rods.end(), values.begin(), read);
  return nav::summarize(values);
}

void summarize_rods(RodArm& arm) {
  for (const BentRod& rod : arm.rods) {
    arm.right_lengths += rod.right_length ? 1 : 0;
    arm.rebends += static_cast<std::size_t>(rod.rebends);
  }
  const nav::Summary time_s = over_rods(arm.rods, [](const BentRod& rod) { return rod.time_s; });
  arm.mean_time_s = time_s.mean;
  arm.time_sd_s = time_s.sd;
  arm.mean_first_try_m =
      over_rods(arm.rods, [](const BentRod& rod) { return rod.first_try_m; }).mean;
  arm.mean_head_distance_m =
      over_rods(arm.rods, [](const BentRod& rod) { return rod.head_distance_m; }).mean;
}

template <class Read>
MeanInterval paired_rods(const RodExperiment& experiment, Read read) {
  const auto& a = experiment.with_template.rods;
  const auto& b = experiment.control.rods;
  std::vector<double> differences(a.size());
  std::transform(a.begin(), a.end(), b.begin(), differences.begin(),
                 [&](const BentRod& one, const BentRod& other) { return read(one) - read(other); });
  return mean_interval(differences);
}

/// The rods of an experiment: the same heads and the same hands in every arm.
struct RodDraw {
  RodTask task;
  Random random;
};

RodDraw drawn_rod(const RodExperimentOptions& options, std::uint64_t seed, std::size_t k) {
  const Random random = Random(seed).fork("rod experiment").fork(std::uint64_t{k});
  return {rod_task(options, random.fork("task")), random};
}

}  // namespace

double elastic_recovery_rad(const RodExperimentOptions& options) {
  return 1.70 * 2.0 * options.yield_pa / (options.modulus_pa * options.rod_diameter_m) *
         options.bend_width_m;
}

RodExperiment run_rod_experiment(const RodExperimentOptions& options, std::uint64_t seed) {
  ORTHONAV_CHECK(options.check().empty());
  RodExperiment experiment;
  for (std::size_t k = 0; k < options.rods; ++k) {
    const auto [task, random] = drawn_rod(options, seed, k);
    experiment.with_template.rods.push_back(
        RodBench(options, task, random.fork("template")).with_template());
    experiment.control.rods.push_back(RodBench(options, task, random.fork("control")).by_eye());
  }
  summarize_rods(experiment.with_template);
  summarize_rods(experiment.control);
  experiment.time_s = paired_rods(experiment, [](const BentRod& rod) { return rod.time_s; });
  experiment.head_distance_m =
      paired_rods(experiment, [](const BentRod& rod) { return rod.head_distance_m; });
  experiment.first_try_m =
      paired_rods(experiment, [](const BentRod& rod) { return rod.first_try_m; });
  experiment.right_length =
      paired_rods(experiment, [](const BentRod& rod) { return rod.right_length ? 1.0 : 0.0; });
  return experiment;
}

InstructedRods run_instructed_rods(const RodExperimentOptions& options, std::uint64_t seed) {
  ORTHONAV_CHECK(options.check().empty());
  InstructedRods out;
  for (std::size_t k = 0; k < options.rods; ++k) {
    const auto [task, random] = drawn_rod(options, seed, k);
    // Uses the random stream of the arm with the template, so that the same surgeon touches the
    // same heads.
    const InstructedRod rod = RodBench(options, task, random.fork("template")).with_instructions();
    out.arm.rods.push_back(rod.rod);
    out.rods.push_back(rod);
    out.refused += rod.bends ? 0 : 1;
    out.bends += rod.bends.value_or(0);
    out.within_of_touched += rod.bends && rod.off_touched_m <= kInstructedLimit_m ? 1 : 0;
    out.within_of_heads += rod.bends && rod.off_heads_m <= kInstructedLimit_m ? 1 : 0;
    out.expected_within += rod.expected_within;
  }
  if (out.rods.size() > out.refused) {
    out.expected_within /= static_cast<double>(out.rods.size() - out.refused);
  }
  summarize_rods(out.arm);
  return out;
}

}  // namespace orthonav::engine
