#include "tests/soak/soak_totals.h"

#include <algorithm>
#include <numeric>

#include "tests/soak/memory_curve.h"
#include "tests/soak/memory_picture.h"

namespace orthonav::soak {
namespace {

/// Of memory, per operation: in eight hours of operations less than 10 MiB.
constexpr double kMaxGrowth_kib = 64.0;
/// Several times what was measured.
constexpr std::int64_t kMaxResident_kib = std::int64_t{1} << 20;

void add(Counts& to, const Counts& counts) {
  for (std::size_t kind = 0; kind < to.size(); ++kind) {
    to[kind] += counts[kind];
  }
}

void print_number(std::FILE* file, std::int64_t number) {
  std::fprintf(file, ",%lld", static_cast<long long>(number));
}

std::int64_t sum_of(const Counts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

}  // namespace

void SoakTotals::add(const SoakRow& row, std::int64_t resident_kib) {
  resident_kib_.push_back(static_cast<double>(resident_kib));
  simulated_s_ += row.simulated_s;
  completed_ += row.completed ? 1 : 0;
  with_reference_ += row.reference ? 1 : 0;
  troubles_ += std::accumulate(row.troubles.begin(), row.troubles.end(), std::int64_t{0});
  full_disks_ += row.full_disk ? 1 : 0;
  resumed_ += row.resumed;
  frames_ += row.frames;
  stale_ += row.stale;
  soak::add(kept_, row.kept);
  soak::add(lost_, row.lost);
  samples_ += row.samples;
  lost_samples_ += row.lost_samples;
  unsaved_ += row.unsaved;
  doubled_ += row.doubled;
  twice_ += row.twice;
  if (!row.trouble.empty()) {
    problems_.push_back("seed " + std::to_string(row.seed) + ": " + row.trouble);
  }
}

double SoakTotals::growth() const {
  return growth_kib(
      {resident_kib_.begin() + static_cast<std::ptrdiff_t>(std::min(kWarmUp, resident_kib_.size())),
       resident_kib_.end()});
}

std::string SoakTotals::picture() const { return memory_picture(resident_kib_, kWarmUp, growth()); }

bool SoakTotals::nothing_lost() const {
  return sum_of(lost_) == 0 && lost_samples_ == 0 && doubled_ == 0 && twice_ == 0;
}

void SoakTotals::print_counts() const {
  std::printf("soak: kept: %lld samples", static_cast<long long>(samples_));
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    std::string name(kKinds[kind]);
    std::replace(name.begin(), name.end(), '_', ' ');
    std::printf(", %lld %s", static_cast<long long>(kept_[kind]), name.c_str());
  }
  std::printf(
      "; lost samples: %lld, lost records: %lld, doubled records: %lld, screws done twice: %lld; "
      "%lld not saved, as was shown\n",
      static_cast<long long>(lost_samples_), static_cast<long long>(sum_of(lost_)),
      static_cast<long long>(doubled_), static_cast<long long>(twice_),
      static_cast<long long>(unsaved_));
}

bool SoakTotals::verdict() const {
  const double most =
      resident_kib_.empty() ? 0.0 : *std::max_element(resident_kib_.begin(), resident_kib_.end());
  const bool enough = operations() >= 2 * kWarmUp;
  const bool good = growth() <= kMaxGrowth_kib && most <= kMaxResident_kib && stale_ == 0 &&
                    nothing_lost() && problems_.empty() && enough;
  for (const std::string& problem : problems_) {
    std::printf("soak: %s\n", problem.c_str());
  }
  print_counts();
  std::printf(
      "soak: %zu operations (%lld to their end, %lld with a patient reference), %.1f simulated "
      "hours, %lld troubles, %lld full disks, %lld resumed; memory %.0f MiB at most (limit %lld), "
      "%+.1f KiB an operation after %zu (limit %.0f)%s; %lld frames, %lld stale: %s\n",
      operations(), static_cast<long long>(completed_), static_cast<long long>(with_reference_),
      simulated_s_ / 3600.0, static_cast<long long>(troubles_), static_cast<long long>(full_disks_),
      static_cast<long long>(resumed_), most / 1024.0,
      static_cast<long long>(kMaxResident_kib / 1024), growth(), kWarmUp, kMaxGrowth_kib,
      enough ? "" : ", too few to tell", static_cast<long long>(frames_),
      static_cast<long long>(stale_), good ? "passed" : "FAILED");
  return good;
}

void write_head(std::FILE* csv) {
  std::fputs("operation,seed,reference,simulated_s,wall_s", csv);
  for (const auto name : kTroubles) {
    std::fprintf(csv, ",%s", std::string(name).c_str());
  }
  std::fputs(",full_disk,resumed,completed,not_saved,frames,stalls_named,stale,samples", csv);
  for (const auto name : kKinds) {
    std::fprintf(csv, ",%s", std::string(name).c_str());
  }
  std::fputs(",lost_samples,lost_records,unsaved,doubled,screws_twice,resident_kib,why_not\n", csv);
}

void write_row(std::FILE* csv, std::size_t number, const SoakRow& row, double wall_s,
               std::int64_t resident_kib) {
  std::fprintf(csv, "%zu,%llu,%d,%.1f,%.1f", number, static_cast<unsigned long long>(row.seed),
               row.reference ? 1 : 0, row.simulated_s, wall_s);
  for (const std::int64_t count : row.troubles) {
    print_number(csv, count);
  }
  std::fprintf(csv, ",%d,%d,%d,%d", row.full_disk ? 1 : 0, row.resumed, row.completed ? 1 : 0,
               row.not_saved ? 1 : 0);
  for (const std::int64_t count : {row.frames, row.stalls, row.stale, row.samples}) {
    print_number(csv, count);
  }
  for (const std::int64_t count : row.kept) {
    print_number(csv, count);
  }
  for (const std::int64_t count :
       {row.lost_samples, sum_of(row.lost), row.unsaved, row.doubled, row.twice, resident_kib}) {
    print_number(csv, count);
  }
  std::fprintf(csv, ",\"%s\"\n", row.why_not.c_str());
  std::fflush(csv);
}

}  // namespace orthonav::soak
