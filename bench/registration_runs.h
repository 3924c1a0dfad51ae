#pragma once

#include <string>
#include <vector>

#include "bench/registration_methods.h"
#include "tests/support/digitized_strokes.h"
#include "tests/support/stroke_truths.h"

namespace orthonav::bench {

/// One method on one set of strokes.
struct Run {
  test::StrokeVariant variant{};
  std::string level;     ///< the level that was stroked
  std::string coverage;  ///< the part of it that was stroked, in words
  std::uint64_t seed = 0;
  std::size_t method = 0;
  bool found = false;
  bool accepted = false;
  std::string reason;
  double rmse_m = 0.0;
  double error_m = 0.0;  ///< the largest at any entry or target
  double ms = 0.0;       ///< of one core
  std::string named;     ///< the level that the points fit better, according to the method
  /// For each entry and target with a predicted error: whether the error lies in the ellipsoid
  /// predicted to hold 68 (95) % of all errors, and whether it is within the length predicted for
  /// 68 (95) %.
  struct Honest {
    bool in_68 = false, in_95 = false, within_68 = false, within_95 = false;
  };
  std::vector<Honest> honest;

  [[nodiscard]] bool right() const;
  [[nodiscard]] bool silent_failure() const { return accepted && !right(); }
};

struct RunOptions {
  std::vector<test::StrokeVariant> variants;
  std::uint64_t first_seed = 1;
  std::uint64_t seeds = 2;
  double deepest_aside = test::StrokeErrorModel{}.deepest_aside;
  test::StrokeTruths truths;
  unsigned jobs = 1;  ///< levels at the same time; changes the times, not the results
};

/// Every level stroked, and fitted by every method. Sorted by level, variant, seed, method.
[[nodiscard]] std::vector<Run> measure(const std::vector<BenchLevel>& levels,
                                       const std::vector<RegistrationMethod>& methods,
                                       const RunOptions& options);

/// The strokes of one level, fitted to another.
struct WrongLevelRun {
  std::string stroked;
  std::string fitted;
  test::StrokeVariant variant{};
  std::size_t method = 0;
  bool accepted = false;
  std::string right;               ///< label of the level that was stroked
  std::string named;               ///< label of the level that the method says it is
  bool right_fits_better = false;  ///< on their own level the same strokes have a smaller RMSE

  [[nodiscard]] bool right_named() const { return named == right; }
  /// Whether a level that was not stroked was named; several that fit alike do not count.
  [[nodiscard]] bool wrong_named() const;
};

/// Every level's strokes, fitted to each other level of its case.
[[nodiscard]] std::vector<WrongLevelRun> measure_wrong_levels(
    const std::vector<BenchLevel>& levels, const std::vector<RegistrationMethod>& methods,
    const RunOptions& options);

}  // namespace orthonav::bench
