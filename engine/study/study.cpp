#include "engine/study/study.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "base/mutex.h"
#include "engine/study/study_text.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

struct Job {
  const Case* source = nullptr;
  std::uint64_t seed = 0;
};

std::vector<Job> jobs_of(std::span<const Case> cases, const StudyOptions& options) {
  std::vector<Job> jobs;
  int number = 0;
  for (const Case& source : cases) {
    for (int run = 0; run < options.runs; ++run, ++number) {
      if (number % options.shards == options.shard - 1) {
        jobs.push_back({&source, options.first_seed + static_cast<std::uint64_t>(run)});
      }
    }
  }
  return jobs;
}

/// Works through the jobs on several threads; each result lies at the index of its job.
class Workers {
 public:
  Workers(std::vector<Job> jobs, const StudyOptions& options,
          const std::function<void(int, int)>& progress)
      : jobs_(std::move(jobs)), options_(options), progress_(progress), reports_(jobs_.size()) {}

  Result<Study> run() {
    std::vector<std::thread> threads;
    const int count = std::min<int>(options_.jobs, static_cast<int>(jobs_.size()));
    for (int i = 1; i < count; ++i) {
      threads.emplace_back([this] { work(); });
    }
    work();
    for (std::thread& thread : threads) {
      thread.join();
    }
    return study();
  }

  /// Begins no further run and ends those under way; from any thread.
  void stop() {
    const MutexLock lock(mutex_);
    stopped_ = true;
    for (const auto& [run, end] : under_way_) {
      end();
    }
  }

 private:
  void work() {
    while (true) {
      const std::size_t i = next_++;
      if (i >= jobs_.size() || is_stopped()) {
        return;
      }
      OperationOptions operation = options_.operation;
      operation.sim.seed = jobs_[i].seed;
      operation.tracker.parallel = options_.jobs < 2;
      OperationHooks hooks;
      hooks.can_stop = [this, i](std::function<void()> end) { set_under_way(i, std::move(end)); };
      take(i, run_operation(*jobs_[i].source, operation, hooks));
    }
  }

  bool is_stopped() {
    const MutexLock lock(mutex_);
    return stopped_;
  }

  /// Null: it has ended.
  void set_under_way(std::size_t run, std::function<void()> end) {
    const MutexLock lock(mutex_);
    if (!end) {
      under_way_.erase(run);
      return;
    }
    if (stopped_) {
      end();
    }
    under_way_[run] = std::move(end);
  }

  void take(std::size_t i, const Result<OperationResult>& result) {
    const MutexLock lock(mutex_);
    if (stopped_ && result && !result->completed) {
      return;  // it may well have been ended for that
    }
    reports_[i] = result ? Result<std::string>(report_json(*result)) : result.error();
    ++done_;
    if (progress_) {
      progress_(done_, static_cast<int>(jobs_.size()));
    }
  }

  [[nodiscard]] Result<Study> study() const {
    Study out;
    Json runs = Json::array();
    Json failed = Json::array();
    const MutexLock lock(mutex_);
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (!reports_[i]) {
        continue;  // stopped before it was made
      }
      if (*reports_[i]) {
        runs.push_back(Json::parse(**reports_[i]));
        continue;
      }
      const std::string& name = jobs_[i].source->name;
      const std::string& why = reports_[i]->error().message;
      failed.push_back(Json{{"case", name}, {"seed", jobs_[i].seed}, {"why", why}});
      if (!out.failure) {
        out.failure =
            Error{"case '" + name + "', seed " + std::to_string(jobs_[i].seed) + ": " + why};
      }
    }
    if (runs.empty() && out.failure) {
      return *out.failure;
    }
    out.text = study_text(options_.operation.method, runs, failed, jobs_.size());
    out.made = done_;
    out.planned = static_cast<int>(jobs_.size());
    return out;
  }

  std::vector<Job> jobs_;
  const StudyOptions& options_;
  const std::function<void(int, int)>& progress_;
  std::atomic<std::size_t> next_ = 0;
  mutable Mutex mutex_;
  std::vector<std::optional<Result<std::string>>> reports_ ORTHONAV_GUARDED_BY(mutex_);
  std::map<std::size_t, std::function<void()>> under_way_ ORTHONAV_GUARDED_BY(mutex_);
  bool stopped_ ORTHONAV_GUARDED_BY(mutex_) = false;
  int done_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

}  // namespace

std::vector<std::string> StudyOptions::check() const {
  std::vector<std::string> problems;
  if (runs < 1) {
    problems.push_back("--runs " + std::to_string(runs) + ": at least 1 needed");
  }
  if (shards < 1 || shard < 1 || shard > shards) {
    problems.push_back("--shard " + std::to_string(shard) + "/" + std::to_string(shards) +
                       ": must be I/N with 1 <= I <= N");
  }
  if (jobs < 1) {
    problems.push_back("--jobs " + std::to_string(jobs) + ": at least 1 needed");
  }
  return problems;
}

Result<Study> run_study(std::span<const Case> cases, const StudyOptions& options,
                        const std::function<void(int, int)>& progress,
                        const std::function<void(std::function<void()>)>& can_stop) {
  const auto problems = options.check();
  if (!problems.empty()) {
    return Error{problems.front()};
  }
  if (cases.empty()) {
    return Error{"study: no case"};
  }
  Workers workers(jobs_of(cases, options), options, progress);
  if (can_stop) {
    can_stop([&workers] { workers.stop(); });
  }
  auto study = workers.run();
  if (can_stop) {
    can_stop(nullptr);
  }
  return study;
}

}  // namespace orthonav::engine
