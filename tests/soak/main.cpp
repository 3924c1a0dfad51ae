// Operation after operation in one process, under injected faults (docs/watchdogs.md, tools/soak).

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/stopwatch.h"
#include "engine/case/operation_plan.h"
#include "engine/io/atomic_file.h"
#include "engine/phantom/phantom.h"
#include "tests/soak/memory_curve.h"
#include "tests/soak/soak_operation.h"
#include "tests/soak/soak_totals.h"

namespace orthonav::soak {
namespace {

/// It goes on until each of these is reached.
struct Arguments {
  double minutes = 0.0;
  double hours = 0.0;  ///< simulated
  std::size_t operations = 0;
  std::uint64_t seed = 1;
  std::string csv;
};

/// At least this many operations, however slow the machine, since fewer do not show growth.
bool enough(const Arguments& asked, const SoakTotals& totals, const Stopwatch& watch) {
  return totals.operations() >= std::max(asked.operations, 2 * kWarmUp) &&
         totals.simulated_s() >= asked.hours * 3600.0 && watch.elapsed_ms() >= asked.minutes * 60e3;
}

/// The drawing lies beside the table.
Status draw(const SoakTotals& totals, const std::string& csv) {
  return engine::write_file(std::filesystem::path(csv).replace_extension(".svg").string(),
                            totals.picture());
}

int soak(const Arguments& arguments) {
  namespace fs = std::filesystem;
  std::FILE* csv = std::fopen(arguments.csv.c_str(), "w");
  if (csv == nullptr) {
    std::fprintf(stderr, "soak: %s: cannot be written\n", arguments.csv.c_str());
    return 2;
  }
  const engine::Case source = engine::phantom();
  const auto planned = engine::plan_operation(source, {});
  if (!planned) {
    std::fprintf(stderr, "soak: %s\n", planned.error().message.c_str());
    return 2;
  }
  write_head(csv);
  SoakTotals totals;
  const Stopwatch watch;
  while (!enough(arguments, totals, watch)) {
    const Stopwatch one;
    const std::string folder =
        (fs::temp_directory_path() / ("orthonav-soak-" + std::to_string(::getpid()))).string();
    fs::remove_all(folder);
    fs::create_directories(folder);
    const SoakRow row =
        soak_operation(source, *planned, arguments.seed + totals.operations(), folder);
    fs::remove_all(folder);
    const std::int64_t resident = resident_kib();
    totals.add(row, resident);
    write_row(csv, totals.operations(), row, one.elapsed_ms() / 1e3, resident);
  }
  std::fclose(csv);
  if (const Status drawn = draw(totals, arguments.csv); !drawn) {
    std::fprintf(stderr, "soak: %s\n", drawn.error().message.c_str());
    return 2;
  }
  return totals.verdict() ? 0 : 1;
}

/// Whether it is one.
bool take(const std::string& name, const char* value, Arguments& arguments) {
  if (name == "--minutes") {
    arguments.minutes = std::atof(value);
  } else if (name == "--hours") {
    arguments.hours = std::atof(value);
  } else if (name == "--operations") {
    arguments.operations = std::strtoull(value, nullptr, 10);
  } else if (name == "--seed") {
    arguments.seed = std::strtoull(value, nullptr, 10);
  } else if (name == "--csv") {
    arguments.csv = value;
  } else {
    return false;
  }
  return true;
}

}  // namespace
}  // namespace orthonav::soak

int main(int argc, char** argv) {
  orthonav::soak::Arguments arguments;
  bool known = argc % 2 == 1;
  for (int i = 1; i + 1 < argc; i += 2) {
    known = orthonav::soak::take(argv[i], argv[i + 1], arguments) && known;
  }
  const bool asked = arguments.minutes > 0.0 || arguments.hours > 0.0 || arguments.operations > 0;
  if (!known || arguments.csv.empty() || !asked) {
    std::fputs(
        "usage: orthonav_soak [--minutes N] [--hours N] [--operations N] --csv FILE [--seed S]\n",
        stderr);
    return 2;
  }
  return orthonav::soak::soak(arguments);
}
