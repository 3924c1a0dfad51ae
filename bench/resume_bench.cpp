// The cost of durability per click, and how soon an operation is resumed, on the disk of a folder:
// bench_resume [FOLDER]. Prints a table; nothing is left in the folder.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <vector>

#include "engine/io/posix_env.h"
#include "engine/session/log/operation_log.h"
#include "tests/support/resumed_operation.h"
#include "tests/support/scripted_surgeon.h"

namespace orthonav {
namespace {

namespace fs = std::filesystem;

constexpr int kClicks = 500;
constexpr int kResumes = 100;
/// The samples of a region that is stroked for 20 s.
constexpr int kSamples = 600;

double ms_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

void print(const char* what, std::vector<double> times_ms) {
  std::sort(times_ms.begin(), times_ms.end());
  const auto quantile = [&](double q) {
    const auto rank = static_cast<std::size_t>(q * static_cast<double>(times_ms.size() - 1) + 0.5);
    return times_ms[rank];
  };
  std::printf("%-44s %5zu  median %8.3f ms  p99 %8.3f ms\n", what, times_ms.size(), quantile(0.5),
              quantile(0.99));
}

/// One record, written and synced.
void measure_clicks(const fs::path& folder, std::size_t bytes, const char* what) {
  engine::PosixEnv env;
  auto log = engine::RecordLog::create(env, (folder / "clicks.log").string(), {1, 1, ""}).value();
  const engine::RecordLog::Entry entry{2, 1, std::string(bytes, 'x')};
  std::vector<double> times_ms;
  for (int i = 0; i < kClicks; ++i) {
    times_ms.push_back(ms_of([&] { std::ignore = log->append(entry); }));
  }
  print(what, times_ms);
  fs::remove(folder / "clicks.log");
}

/// The part for which the session itself waits: the record is made and handed over.
void measure_handing_over(const fs::path& folder) {
  engine::PosixEnv env;
  auto s = test::touched_operation(true);
  auto log = engine::OperationLog::begin(env, folder.string(), test::identity_of(*s, true),
                                         s->session().levels(), engine::RecordWriter::Waits::kNot,
                                         engine::RecordLog::Earlier::kKept)
                 .value();
  nav::Region region;
  region.saved = true;
  region.samples.resize(kSamples);
  std::vector<double> times_ms;
  for (int i = 0; i < kResumes; ++i) {
    times_ms.push_back(
        ms_of([&] { log->region_saved(Timestamp{}, s->session().levels()[0], region); }));
  }
  print("region of 600 samples handed over", times_ms);
  std::ignore = log->finish(false, "");
  log.reset();
  fs::remove(folder / "operation.resume");
}

/// An operation that was killed at its last screw is found, read, and restored.
void measure_resuming(const fs::path& folder) {
  engine::PosixEnv env;
  {
    auto s = test::touched_operation(true);
    auto log = engine::OperationLog::begin(
                   env, folder.string(), test::identity_of(*s, true), s->session().levels(),
                   engine::RecordWriter::Waits::kUntilDurable, engine::RecordLog::Earlier::kKept)
                   .value();
    s->session().observe(log.get());
    test::ScriptedSurgeon surgeon(*s, kSamples);
    while (s->session().current_step() != engine::Step::kRod && surgeon.act()) {
    }
  }
  std::printf("operation.resume: %ju bytes\n",
              static_cast<std::uintmax_t>(fs::file_size(folder / "operation.resume")));
  std::vector<double> times_ms;
  for (int i = 0; i < kResumes; ++i) {
    auto s = test::touched_operation(true);
    times_ms.push_back(ms_of([&] {
      auto found = engine::OperationLog::find(env, folder.string()).value();
      engine::LoggedOperation logged = found.operation;
      logged.reopen();
      s->tracker().reference.places = logged.references;
      std::ignore = s->session().resume(logged);
      std::ignore = engine::OperationLog::reopen(env, std::move(found),
                                                 engine::RecordWriter::Waits::kUntilDurable);
    }));
  }
  print("found, read, restored and continued", times_ms);
  fs::remove(folder / "operation.resume");
}

}  // namespace
}  // namespace orthonav

int main(int argc, char** argv) {
  const std::filesystem::path folder =
      std::filesystem::path(argc > 1 ? argv[1] : ".") / "bench-resume";
  std::filesystem::create_directories(folder);
  orthonav::measure_clicks(folder, 1000, "record of 1 kB written and synced");
  orthonav::measure_clicks(folder, 80'000, "region of 80 kB written and synced");
  orthonav::measure_handing_over(folder);
  orthonav::measure_resuming(folder);
  std::filesystem::remove(folder);
  return 0;
}
