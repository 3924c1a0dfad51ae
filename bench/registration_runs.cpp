#include "bench/registration_runs.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <thread>

#include "base/random.h"
#include "bench/predicted_coverage.h"
#include "nav/registration/findings.h"

namespace orthonav::bench {
namespace {

constexpr double kRight_m = 0.002;
/// The published method's limit, by which peers count as accepted.
constexpr double kPeerMaxRmse_m = 0.003;

/// Each level gets strokes of its own from a seed.
test::DigitizedStrokes strokes_of(const BenchLevel& level, test::StrokeVariant variant,
                                  std::uint64_t seed, const RunOptions& options) {
  test::StrokeErrorModel error_model = test::error_model_of(variant);
  error_model.deepest_aside = options.deepest_aside;
  const std::uint64_t own_seed = Random(seed).fork(level.name()).next();
  auto strokes = test::digitize_strokes(level.mesh, variant, own_seed, error_model);
  if (!strokes) {
    std::fprintf(stderr, "%s: %s\n", level.name().c_str(), strokes.error().message.c_str());
    std::exit(2);
  }
  test::apply_truths(options.truths, level.mesh, own_seed, *strokes);
  return std::move(*strokes);
}

double rmse_m(const nav::VertebraModel& model, const Transform<World, Vertebra>& pose,
              std::span<const Point<World>> points) {
  const auto inverse = pose.inverse();
  double sum_m2 = 0.0;
  for (const Point<World>& point : points) {
    const auto near = model.reachable_surface().nearest((inverse * point).v);
    sum_m2 += near ? near->distance_m * near->distance_m : 1.0;
  }
  return std::sqrt(sum_m2 / static_cast<double>(points.size()));
}

/// CPU time of this thread, so that other load does not count.
double own_time_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// Fits, and judges the result of peers that don't judge it themselves.
Fitted fitted_by(const RegistrationMethod& method, const Fit& fit, const BenchLevel& level,
                 const test::DigitizedStrokes& strokes, double& ms) {
  const std::vector<Point<World>> points = strokes.tips();
  const std::vector<double> times_s = strokes.times_s();
  const double before_ms = own_time_ms();
  Fitted fitted = fit(points, times_s);
  ms = own_time_ms() - before_ms;
  if (method.judges || !fitted.found) {
    return fitted;
  }
  fitted.rmse_m = rmse_m(*level.model, fitted.world_from_vertebra, points);
  fitted.accepted = fitted.rmse_m <= kPeerMaxRmse_m;
  return fitted;
}

void compare(const BenchLevel& level, const Transform<World, Vertebra>& truth, const Fitted& fitted,
             Run& run) {
  // In the model's frame, to which the covariance refers.
  const auto moved = truth.inverse() * fitted.world_from_vertebra;
  for (const nav::ScrewPlan& screw : level.screws) {
    for (const Point<Vertebra> at : {screw.entry, screw.target}) {
      const Vec3 error_m = moved * at - at;
      run.error_m = std::max(run.error_m, error_m.norm());
      if (!fitted.covariance) {
        continue;
      }
      const Mat3 covariance = fitted.covariance(at);
      const PredictedCoverage predicted(covariance);
      run.honest.push_back(
          {predicted.in_ellipsoid(error_m, 0.68), predicted.in_ellipsoid(error_m, 0.95),
           predicted.no_longer(error_m, 0.68), predicted.no_longer(error_m, 0.95)});
    }
  }
}

void measure_level(const BenchLevel& level, const std::vector<RegistrationMethod>& methods,
                   const RunOptions& options, std::vector<Run>& runs) {
  std::vector<Fit> fits;
  for (const auto& method : methods) {
    fits.push_back(method.prepare(level));
  }
  for (const auto variant : options.variants) {
    for (std::uint64_t k = 0; k < options.seeds; ++k) {
      const std::uint64_t seed = options.first_seed + k;
      const auto strokes = strokes_of(level, variant, seed, options);
      for (std::size_t m = 0; m < methods.size(); ++m) {
        Run run{variant, level.name(), strokes.coverage, seed, m};
        const Fitted fitted = fitted_by(methods[m], fits[m], level, strokes, run.ms);
        run.found = fitted.found;
        run.accepted = fitted.accepted;
        run.reason = fitted.reason;
        run.named = fitted.fits_better;
        run.rmse_m = fitted.rmse_m;
        if (run.found) {
          compare(level, strokes.world_from_vertebra, fitted, run);
        }
        runs.push_back(std::move(run));
      }
    }
  }
}

/// Strokes of a level, and a method's result for them there.
struct OnOwnLevel {
  test::StrokeVariant variant{};
  test::DigitizedStrokes strokes;
  bool found = false;
  double rmse_m = 0.0;
};

std::vector<OnOwnLevel> on_own_level(const BenchLevel& level, const RegistrationMethod& method,
                                     const RunOptions& options) {
  const Fit fit = method.prepare(level);
  std::vector<OnOwnLevel> sets;
  for (const auto variant : options.variants) {
    for (std::uint64_t k = 0; k < options.seeds; ++k) {
      OnOwnLevel set{variant, strokes_of(level, variant, options.first_seed + k, options)};
      double ms = 0.0;
      const Fitted right = fitted_by(method, fit, level, set.strokes, ms);
      set.found = right.found;
      set.rmse_m = right.rmse_m;
      sets.push_back(std::move(set));
    }
  }
  return sets;
}

/// Calls `work` for 0 to count - 1, some of them concurrently.
template <class Work>
void in_parallel(std::size_t count, unsigned jobs, const Work& work) {
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      work(i);
    }
  };
  std::vector<std::jthread> threads;
  for (unsigned j = 1; j < jobs; ++j) {
    threads.emplace_back(take);
  }
  take();
}

template <class T>
std::vector<T> joined(std::vector<std::vector<T>>& parts) {
  std::vector<T> all;
  for (auto& part : parts) {
    for (auto& one : part) {
      all.push_back(std::move(one));
    }
  }
  return all;
}

}  // namespace

bool WrongLevelRun::wrong_named() const {
  return !named.empty() && named != right && named != nav::kSeveralLevels;
}

bool Run::right() const { return found && error_m < kRight_m; }

std::vector<Run> measure(const std::vector<BenchLevel>& levels,
                         const std::vector<RegistrationMethod>& methods,
                         const RunOptions& options) {
  std::vector<std::vector<Run>> parts(levels.size());
  in_parallel(levels.size(), options.jobs,
              [&](std::size_t i) { measure_level(levels[i], methods, options, parts[i]); });
  return joined(parts);
}

std::vector<WrongLevelRun> measure_wrong_levels(const std::vector<BenchLevel>& levels,
                                                const std::vector<RegistrationMethod>& methods,
                                                const RunOptions& options) {
  std::vector<std::vector<WrongLevelRun>> parts(levels.size());
  in_parallel(levels.size(), options.jobs, [&](std::size_t i) {
    const BenchLevel& stroked = levels[i];
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const std::vector<OnOwnLevel> sets = on_own_level(stroked, methods[m], options);
      for (const BenchLevel& other : levels) {
        if (&other == &stroked || other.case_name != stroked.case_name) {
          continue;
        }
        const Fit fit = methods[m].prepare(other);
        for (const OnOwnLevel& set : sets) {
          double ms = 0.0;
          const Fitted wrong = fitted_by(methods[m], fit, other, set.strokes, ms);
          const bool better = set.found && (!wrong.found || set.rmse_m < wrong.rmse_m);
          parts[i].push_back({stroked.name(), other.name(), set.variant, m, wrong.accepted,
                              stroked.label, wrong.fits_better, better});
        }
      }
    }
  });
  return joined(parts);
}

}  // namespace orthonav::bench
