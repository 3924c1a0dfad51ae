// Whole operations with the method's registration, and with that of nav/posterior in its place: the
// same case, seeds and set-up, the measurement model with reference, closed loop and sleeved drill.
//   bench_registered_operations --runs 12 [--first-seed 1] [--case DIR] [--levels L4,L5]
// Prints a table. For either: how many operations were completed, entry and angle of the screws,
// guides that were far off without a warning, how often the guide's shown SDs held, attempts and
// points of a level, how long it was stroked.

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/case/case_file.h"
#include "engine/case/tool_file.h"
#include "engine/phantom/phantom.h"
#include "nav/registration/registered.h"
#include "study/guided_statistics.h"
#include "study/set_up.h"
#include "study/simulated_operation.h"

namespace orthonav {
namespace {

Result<nav::Registration> by_posterior(const engine::RegistrationRequest& request) {
  return nav::posterior::register_by_posterior(request.model, request.points_in_world,
                                               engine::options_of(request));
}

/// Mean and SD.
struct Spread {
  double n = 0.0, sum = 0.0, squares = 0.0;
  void add(double x) {
    n += 1.0;
    sum += x;
    squares += x * x;
  }
  [[nodiscard]] std::string text() const {
    char out[64];
    const double mean = sum / n;
    std::snprintf(out, sizeof out, "%.2f +- %.2f", mean,
                  std::sqrt(std::max(0.0, squares / n - mean * mean)));
    return n > 0.0 ? out : "-";
  }
};

struct Summary {
  int runs = 0, completed = 0, silent_levels = 0;
  Spread entry_mm, angle_deg, tre_mm, attempts, points, stroked_s;
  engine::GuidedQuality guided;

  void add(const nlohmann::ordered_json& run) {
    ++runs;
    completed += run["completed"].get<bool>() ? 1 : 0;
    engine::add_run(run, guided);
    for (const auto& level : run["levels"]) {
      if (!level.value("accepted", false)) {
        continue;
      }
      attempts.add(level["attempts"]);
      points.add(level["points"]);
      stroked_s.add(level["digitization_s"]);
      tre_mm.add(level["tre_mm"]);
      silent_levels += level["tre_mm"].get<double>() > 2.0 ? 1 : 0;
      for (const auto& screw : level["screws"]) {
        if (screw.contains("entry_error_mm")) {
          entry_mm.add(screw["entry_error_mm"]);
          angle_deg.add(screw["angle_error_deg"]);
        }
      }
    }
  }

  void print(const char* name) const {
    const auto held = engine::guided_json(guided)["within_shown_sds"];
    std::printf(
        "| %s | %d of %d | %s | %s | %s | %d of %.0f | %d of %zu | %d, %d of %d | %s | %s | %s "
        "|\n",
        name, completed, runs, entry_mm.text().c_str(), angle_deg.text().c_str(),
        tre_mm.text().c_str(), silent_levels, tre_mm.n, guided.silent, guided.across_mm.size(),
        held["in_68"].get<int>(), held["in_95"].get<int>(), held["of"].get<int>(),
        attempts.text().c_str(), points.text().c_str(), stroked_s.text().c_str());
  }
};

/// By the method's own registration, or by the other one.
Status operate(const engine::Case& source, const engine::OperationOptions& options, bool posterior,
               Summary& summary) {
  engine::OperationHooks hooks;
  if (posterior) {
    hooks.adapt = [](const sim::SimHeadset&, engine::Method& method) {
      method.registrar = &by_posterior;
    };
  }
  const auto result = engine::run_operation(source, options, hooks);
  if (!result) {
    return result.error();
  }
  summary.add(nlohmann::ordered_json::parse(engine::report_json(*result)));
  return {};
}

int run(int argc, char** argv) {
  CLI::App app{"Whole operations by the registration in use and by the one that is to come"};
  int runs = 12;
  std::uint64_t first_seed = 1;
  std::string folder;
  engine::OperationOptions options;
  app.add_option("--runs", runs)->check(CLI::PositiveNumber);
  app.add_option("--first-seed", first_seed);
  app.add_option("--case", folder, "default: the built-in phantom");
  app.add_option("--levels", options.levels, "default: the two lowest")->delimiter(',');
  bool on_map = false;
  app.add_flag("--map", on_map, "over the headset's map, without a patient reference");
  CLI11_PARSE(app, argc, argv);
  const auto source =
      folder.empty() ? Result<engine::Case>(engine::phantom()) : engine::load_case(folder);
  const engine::SetUp set_up = engine::SetUp::best();
  options.measurement = engine::Measurement::kModel;
  options.tools = engine::built_in_tools();
  options.use_reference = set_up.reference && !on_map;
  options.loop.draw_every = 0;
  options.session.live_clearance = false;
  Status status = source ? set_up.tell(options.sim) : Status(source.error());
  Summary best, posterior;
  for (int k = 0; k < runs && status; ++k) {
    options.sim.seed = first_seed + static_cast<std::uint64_t>(k);
    status = operate(*source, options, false, best);
    if (status) {
      status = operate(*source, options, true, posterior);
    }
    std::fprintf(stderr, "%d of %d\n", k + 1, runs);
  }
  if (!status) {
    std::fprintf(stderr, "bench_registered_operations: %s\n", status.error().message.c_str());
    return 1;
  }
  std::printf(
      "| registration | completed | entry mm | angle deg | error at the worst target mm | levels "
      "beyond 2 mm | silent guides | shown SDs hold 68, 95 %% | attempts | points | stroked s |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  best.print("best");
  posterior.print("posterior");
  return 0;
}

}  // namespace
}  // namespace orthonav

int main(int argc, char** argv) { return orthonav::run(argc, argv); }
