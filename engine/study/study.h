#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/study/simulated_operation.h"

namespace orthonav::engine {

struct StudyOptions {
  OperationOptions operation;  ///< its seed is replaced
  int runs = 20;               ///< a case, with the seeds first_seed, first_seed + 1, ...
  std::uint64_t first_seed = 1;
  int shard = 1;  ///< of `shards`, from 1: every shards-th run
  int shards = 1;
  int jobs = 1;  ///< operations at once; no figure depends on it

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// A study, and the first thing that kept a run of it from being made.
struct Study {
  std::string text;
  std::optional<Error> failure;
};

/// Many simulated operations as one JSON text: `runs` holds every run's report, ordered by case and
/// seed, `table` the rows of the paper's Table 1 over all of them. Called after each run with how
/// many are done of how many, from any thread, one at a time. A run that could not be made stands
/// in `failed` with the reason, the others are kept; an Error where none could.
Result<Study> run_study(std::span<const Case> cases, const StudyOptions& options,
                        const std::function<void(int, int)>& progress = {});

/// Joins the texts of shards as if they had been one study. `names` stand for them in messages.
/// Refuses what is no study, different methods, and a run that occurs twice.
Result<std::string> merge_studies(std::span<const std::string> texts,
                                  std::span<const std::string> names);

}  // namespace orthonav::engine
