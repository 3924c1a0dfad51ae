// Operation after operation in one process, in bad weather (docs/watchdogs.md, tools/soak).

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "engine/case/operation_plan.h"
#include "engine/phantom/phantom.h"
#include "tests/soak/memory_curve.h"
#include "tests/soak/soak_operation.h"

namespace orthonav::soak {
namespace {

/// Operations until caches and the heap have their final size.
constexpr std::size_t kWarmUp = 8;
/// Of memory, per operation: in eight hours of operations less than 10 MiB.
constexpr double kMostGrowth_kib = 64.0;
/// Several times what was measured.
constexpr std::int64_t kMostResident_kib = std::int64_t{1} << 20;

struct Arguments {
  double minutes = 10.0;
  std::uint64_t seed = 1;
  std::string csv;
};

struct Totals {
  std::vector<double> resident_kib;
  double simulated_s = 0.0;
  std::int64_t completed = 0;
  std::int64_t troubles = 0;
  std::int64_t full_disks = 0;
  std::int64_t resumed = 0;
  std::int64_t frames = 0;
  std::int64_t stale = 0;
  std::int64_t lost = 0;
  std::vector<std::string> problems;
};

void write_head(std::FILE* csv) {
  std::fputs("operation,seed,simulated_s,wall_s", csv);
  for (const auto name : kTroubles) {
    std::fprintf(csv, ",%s", std::string(name).c_str());
  }
  std::fputs(
      ",full_disk,resumed,completed,not_saved,frames,stalls_named,stale,screws,lost,"
      "resident_kib,why_not\n",
      csv);
}

void write_row(std::FILE* csv, std::size_t number, const SoakRow& row, double wall_s,
               std::int64_t resident) {
  std::fprintf(csv, "%zu,%llu,%.1f,%.1f", number, static_cast<unsigned long long>(row.seed),
               row.simulated_s, wall_s);
  for (const std::int64_t count : row.troubles) {
    std::fprintf(csv, ",%lld", static_cast<long long>(count));
  }
  std::fprintf(csv, ",%d,%d,%d,%d,%lld,%lld,%lld,%lld,%lld,%lld,\"%s\"\n", row.full_disk ? 1 : 0,
               row.resumed, row.completed ? 1 : 0, row.not_saved ? 1 : 0,
               static_cast<long long>(row.frames), static_cast<long long>(row.stalls),
               static_cast<long long>(row.stale), static_cast<long long>(row.screws),
               static_cast<long long>(row.lost), static_cast<long long>(resident),
               row.why_not.c_str());
  std::fflush(csv);
}

void add(Totals& totals, const SoakRow& row) {
  totals.simulated_s += row.simulated_s;
  totals.completed += row.completed ? 1 : 0;
  for (const std::int64_t count : row.troubles) {
    totals.troubles += count;
  }
  totals.full_disks += row.full_disk ? 1 : 0;
  totals.resumed += row.resumed;
  totals.frames += row.frames;
  totals.stale += row.stale;
  totals.lost += row.lost;
  if (!row.trouble.empty()) {
    totals.problems.push_back("seed " + std::to_string(row.seed) + ": " + row.trouble);
  }
}

/// Prints it in one line; 1 where anything is not as it must be.
int verdict(const Totals& totals) {
  const std::vector<double>& all = totals.resident_kib;
  const std::vector<double> warm(
      all.begin() + static_cast<std::ptrdiff_t>(std::min(kWarmUp, all.size())), all.end());
  const double growth = growth_kib(warm);
  const double most = all.empty() ? 0.0 : *std::max_element(all.begin(), all.end());
  const bool enough = warm.size() >= kWarmUp;
  const bool good = growth <= kMostGrowth_kib && most <= kMostResident_kib && totals.stale == 0 &&
                    totals.lost == 0 && totals.problems.empty() && enough;
  for (const std::string& problem : totals.problems) {
    std::printf("soak: %s\n", problem.c_str());
  }
  std::printf(
      "soak: %zu operations (%lld to their end), %.1f simulated hours, %lld troubles, %lld full "
      "disks, %lld resumed; memory %.0f MiB at most (limit %lld), %+.1f KiB an operation after "
      "%zu (limit %.0f)%s; %lld frames, %lld stale, %lld screws lost: %s\n",
      all.size(), static_cast<long long>(totals.completed), totals.simulated_s / 3600.0,
      static_cast<long long>(totals.troubles), static_cast<long long>(totals.full_disks),
      static_cast<long long>(totals.resumed), most / 1024.0,
      static_cast<long long>(kMostResident_kib / 1024), growth, kWarmUp, kMostGrowth_kib,
      enough ? "" : ", too few to tell", static_cast<long long>(totals.frames),
      static_cast<long long>(totals.stale), static_cast<long long>(totals.lost),
      good ? "passed" : "FAILED");
  return good ? 0 : 1;
}

int soak(const Arguments& arguments) {
  namespace fs = std::filesystem;
  std::FILE* csv = std::fopen(arguments.csv.c_str(), "w");
  if (csv == nullptr) {
    std::fprintf(stderr, "soak: %s: cannot be written\n", arguments.csv.c_str());
    return 2;
  }
  const engine::Case source = engine::phantom();
  engine::ModelCache models;
  const auto planned = engine::plan_operation(source, {}, models);
  if (!planned) {
    std::fprintf(stderr, "soak: %s\n", planned.error().message.c_str());
    return 2;
  }
  write_head(csv);
  Totals totals;
  const Stopwatch watch;
  // At least so many operations, however slow the machine: fewer tell nothing of growth.
  for (std::size_t i = 0; i < 2 * kWarmUp || watch.elapsed_ms() < arguments.minutes * 60e3; ++i) {
    const Stopwatch one;
    const std::string folder =
        (fs::temp_directory_path() / ("orthonav-soak-" + std::to_string(::getpid()))).string();
    fs::remove_all(folder);
    fs::create_directories(folder);
    const SoakRow row = soak_operation(source, *planned, arguments.seed + i, folder);
    fs::remove_all(folder);
    totals.resident_kib.push_back(static_cast<double>(resident_kib()));
    add(totals, row);
    write_row(csv, i + 1, row, one.elapsed_ms() / 1e3,
              static_cast<std::int64_t>(totals.resident_kib.back()));
  }
  std::fclose(csv);
  return verdict(totals);
}

}  // namespace
}  // namespace orthonav::soak

int main(int argc, char** argv) {
  orthonav::soak::Arguments arguments;
  bool known = argc % 2 == 1;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    if (name == "--minutes") {
      arguments.minutes = std::atof(argv[i + 1]);
    } else if (name == "--seed") {
      arguments.seed = std::strtoull(argv[i + 1], nullptr, 10);
    } else if (name == "--csv") {
      arguments.csv = argv[i + 1];
    } else {
      known = false;
    }
  }
  if (!known || arguments.csv.empty() || !(arguments.minutes > 0.0)) {
    std::fputs("usage: orthonav_soak --minutes N --csv FILE [--seed S]\n", stderr);
    return 2;
  }
  return orthonav::soak::soak(arguments);
}
