#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/simulated_operation.h"

namespace orthonav::engine {

struct StudyOptions {
  OperationOptions operation;  ///< its seed is replaced
  int runs = 20;               ///< per case, with the seeds first_seed, first_seed + 1, ...
  std::uint64_t first_seed = 1;
  int shard = 1;  ///< of `shards`, from 1: every shards-th run
  int shards = 1;
  int jobs = 1;  ///< operations at the same time; no figure depends on it
  /// An SQLite file that stores each finished operation; empty: none. Operations already in it are
  /// not run again.
  std::string store;
  std::string version;  ///< of the program; part of a stored study's definition

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// A study, and why the first failed run failed.
struct Study {
  std::string text;
  std::optional<Error> failure;
  int made = 0;     ///< runs made or tried
  int planned = 0;  ///< larger if it was stopped
};

/// Many simulated operations as one JSON text: `runs` holds every run's report, ordered by case and
/// seed; `table` the rows of the paper's Table 1 over all of them. `progress` is called after each
/// run with the number done and the total, from any thread, one call at a time. A failed run is
/// listed in `failed` with the reason, and the others are kept; an Error if all failed. `can_stop`
/// receives a function that stops the study, callable from any thread, and null at its end:
/// unfinished runs then do not count, and the text says `incomplete`.
Result<Study> run_study(std::span<const Case> cases, const StudyOptions& options,
                        const std::function<void(int, int)>& progress = {},
                        const std::function<void(std::function<void()>)>& can_stop = {});

}  // namespace orthonav::engine
