#include "bench/registration_tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "bench/wilson.h"

namespace orthonav::bench {
namespace {

double quantile(std::vector<double> v, double q) {
  if (v.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  std::sort(v.begin(), v.end());
  return v[static_cast<std::size_t>(std::ceil(q * static_cast<double>(v.size() - 1)))];
}

/// "3 (0.2–1.4 %)": of so many, with the interval.
std::string counted(std::size_t count, std::size_t all) {
  const FractionInterval interval = wilson(static_cast<double>(count), all);
  char text[64];
  std::snprintf(text, sizeof text, "%zu (%.1f–%.1f %%)", count, 100.0 * interval.low,
                100.0 * interval.high);
  return text;
}

/// What of the places of the accepted runs is `in`. The places of one run are wrong together: the
/// interval counts the runs.
std::string fraction_of_places(const std::vector<Run>& runs, bool Run::Honest::*in) {
  double sum = 0.0;
  std::size_t accepted = 0;
  for (const Run& run : runs) {
    if (!run.accepted || run.honest.empty()) {
      continue;
    }
    ++accepted;
    for (const Run::Honest& h : run.honest) {
      sum += h.*in ? 1.0 / static_cast<double>(run.honest.size()) : 0.0;
    }
  }
  if (accepted == 0) {
    return "–";
  }
  const FractionInterval interval = wilson(sum, accepted);
  char text[64];
  std::snprintf(text, sizeof text, "%.1f (%.1f–%.1f)", 100.0 * sum / static_cast<double>(accepted),
                100.0 * interval.low, 100.0 * interval.high);
  return text;
}

using Variants = std::vector<test::StrokeVariant>;
using Methods = std::vector<RegistrationMethod>;

/// Calls `row` for every variant and method, and for all variants together where there are several.
template <class R, class Row>
void for_rows(const std::vector<R>& runs, const Methods& methods, const Variants& variants,
              const Row& row) {
  std::vector<std::optional<test::StrokeVariant>> groups(variants.begin(), variants.end());
  if (variants.size() > 1) {
    groups.emplace_back(std::nullopt);
  }
  for (const auto& group : groups) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
      std::vector<R> chosen;
      for (const R& run : runs) {
        if (run.method == m && (!group || run.variant == *group)) {
          chosen.push_back(run);
        }
      }
      row(group ? test::name_of(*group) : "all", m, chosen);
    }
  }
}

std::vector<double> values(const std::vector<Run>& runs,
                           const std::function<std::optional<double>(const Run&)>& of) {
  std::vector<double> v;
  for (const Run& run : runs) {
    if (const auto value = of(run)) {
      v.push_back(*value);
    }
  }
  return v;
}

std::optional<double> error_mm(const Run& run) {
  return run.found ? 1e3 * run.error_m : std::numeric_limits<double>::infinity();
}
std::optional<double> accepted_error_mm(const Run& run) {
  return run.accepted ? std::optional(1e3 * run.error_m) : std::nullopt;
}
std::optional<double> right_error_mm(const Run& run) {
  return run.right() ? std::optional(1e3 * run.error_m) : std::nullopt;
}

}  // namespace

void print_summary_head() {
  std::printf(
      "| truth | strokes | method | runs | accepted | silent failures, of these | median error, mm "
      "| in the 68 %% ellipsoid | in the 95 %% ellipsoid | names another level | median ms | p99 "
      "ms "
      "|\n|---|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
}

void print_summary(const std::string& truth, const std::vector<Run>& runs, const Methods& methods,
                   const Variants& variants) {
  for_rows(runs, methods, variants,
           [&](const char* group, std::size_t m, const std::vector<Run>& chosen) {
             std::size_t accepted = 0, silent = 0, named = 0;
             for (const Run& run : chosen) {
               accepted += run.accepted ? 1 : 0;
               silent += run.silent_failure() ? 1 : 0;
               named += run.named.empty() ? 0 : 1;
             }
             const auto ms = values(chosen, [](const Run& r) { return std::optional(r.ms); });
             std::printf("| %s | %s | %s | %zu | %s | %s | %.2f | %s | %s | %zu | %.1f | %.1f |\n",
                         truth.c_str(), group, methods[m].name.c_str(), chosen.size(),
                         counted(accepted, chosen.size()).c_str(),
                         counted(silent, accepted).c_str(),
                         quantile(values(chosen, accepted_error_mm), 0.5),
                         fraction_of_places(chosen, &Run::Honest::in_68).c_str(),
                         fraction_of_places(chosen, &Run::Honest::in_95).c_str(), named,
                         quantile(ms, 0.5), quantile(ms, 0.99));
           });
  std::fflush(stdout);
}

void print_success(const std::vector<Run>& runs, const Methods& methods, const Variants& variants) {
  std::printf(
      "| strokes | method | runs | right | accepted | silent failures | median error, mm | "
      "where right | accepted: median | p95 | max | median ms | p99 ms "
      "|\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for_rows(
      runs, methods, variants,
      [&](const char* group, std::size_t m, const std::vector<Run>& chosen) {
        const auto accepted = values(chosen, accepted_error_mm);
        const auto count = [&](auto&& is) {
          return static_cast<int>(std::count_if(chosen.begin(), chosen.end(), is));
        };
        const auto ms = values(chosen, [](const Run& r) { return std::optional(r.ms); });
        std::printf(
            "| %s | %s | %zu | %d | %d | %d | %.2f | %.2f | %.2f | %.2f | %.2f | %.1f | %.1f |\n",
            group, methods[m].name.c_str(), chosen.size(),
            count([](const Run& r) { return r.right(); }),
            count([](const Run& r) { return r.accepted; }),
            count([](const Run& r) { return r.silent_failure(); }),
            quantile(values(chosen, error_mm), 0.5), quantile(values(chosen, right_error_mm), 0.5),
            quantile(accepted, 0.5), quantile(accepted, 0.95), quantile(accepted, 1.0),
            quantile(ms, 0.5), quantile(ms, 0.99));
      });
}

void print_against_first(const std::vector<Run>& runs, const Methods& methods,
                         const Variants& variants) {
  std::printf(
      "| strokes | method | both right | median error, mm | of %s | ratio |\n"
      "|---|---|---:|---:|---:|---:|\n",
      methods[0].name.c_str());
  std::vector<Run> first;
  for_rows(runs, methods, variants,
           [&](const char* group, std::size_t m, const std::vector<Run>& chosen) {
             if (m == 0) {
               first = chosen;
               return;
             }
             std::vector<double> own_mm, first_mm;
             for (std::size_t i = 0; i < chosen.size(); ++i) {
               if (!chosen[i].right() || !first[i].right()) {
                 continue;
               }
               own_mm.push_back(1e3 * chosen[i].error_m);
               first_mm.push_back(1e3 * first[i].error_m);
             }
             const double own = quantile(own_mm, 0.5);
             const double other = quantile(first_mm, 0.5);
             std::printf("| %s | %s | %zu | %.3f | %.3f | %.2f |\n", group, methods[m].name.c_str(),
                         own_mm.size(), own, other, own / other);
           });
}

void print_honesty(const std::vector<Run>& runs, const Methods& methods, const Variants& variants) {
  std::printf(
      "| strokes | method | accepted | in the 68 %% ellipsoid | in the 95 %% ellipsoid | "
      "no longer than 68 %% | no longer than 95 %% |\n|---|---|---:|---:|---:|---:|---:|\n");
  for_rows(runs, methods, variants,
           [&](const char* group, std::size_t m, const std::vector<Run>& chosen) {
             double in[4] = {};
             double all = 0.0;
             std::size_t accepted = 0;
             for (const Run& run : chosen) {
               if (!run.accepted || run.honest.empty()) {
                 continue;
               }
               ++accepted;
               for (const Run::Honest& h : run.honest) {
                 const bool is[4] = {h.in_68, h.in_95, h.within_68, h.within_95};
                 for (int k = 0; k < 4; ++k) {
                   in[k] += is[k] ? 100.0 : 0.0;
                 }
                 all += 1.0;
               }
             }
             if (accepted == 0) {
               return;
             }
             std::printf("| %s | %s | %zu | %.1f %% | %.1f %% | %.1f %% | %.1f %% |\n", group,
                         methods[m].name.c_str(), accepted, in[0] / all, in[1] / all, in[2] / all,
                         in[3] / all);
           });
}

void print_wrong_levels(const std::vector<WrongLevelRun>& runs, const Methods& methods,
                        const Variants& variants) {
  std::printf(
      "| strokes | method | runs | accepted | the right level fits better | it is named | a wrong "
      "one is |\n|---|---|---:|---:|---:|---:|---:|\n");
  for_rows(runs, methods, variants,
           [&](const char* group, std::size_t m, const std::vector<WrongLevelRun>& chosen) {
             std::size_t accepted = 0, better = 0, named = 0, wrong = 0;
             for (const WrongLevelRun& run : chosen) {
               accepted += run.accepted ? 1 : 0;
               better += run.right_fits_better ? 1 : 0;
               named += run.right_named() ? 1 : 0;
               wrong += run.wrong_named() ? 1 : 0;
             }
             const std::size_t all = chosen.size();
             std::printf("| %s | %s | %zu | %s | %s | %s | %s |\n", group, methods[m].name.c_str(),
                         all, counted(accepted, all).c_str(), counted(better, all).c_str(),
                         counted(named, all).c_str(), counted(wrong, all).c_str());
           });
}

void print_each(const std::vector<Run>& runs, const Methods& methods) {
  std::printf(
      "| level | strokes | seed | method | verdict | error, mm | RMSE, mm | ms | says |\n"
      "|---|---|---:|---|---|---:|---:|---:|---|\n");
  for (const Run& run : runs) {
    std::printf("| %s | %s: %s | %llu | %s | %s%s | %.2f | %.2f | %.1f | %s |\n", run.level.c_str(),
                test::name_of(run.variant), run.coverage.c_str(),
                static_cast<unsigned long long>(run.seed), methods[run.method].name.c_str(),
                run.right() ? "right" : "WRONG", run.accepted ? ", accepted" : "",
                1e3 * run.error_m, 1e3 * run.rmse_m, run.ms, run.reason.c_str());
  }
}

}  // namespace orthonav::bench
