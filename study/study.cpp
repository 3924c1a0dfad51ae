#include "study/study.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/mutex.h"
#include "engine/case/operation_plan.h"
#include "study/on_threads.h"
#include "study/study_definition.h"
#include "study/study_store.h"
#include "study/study_text.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

struct Job {
  const Case* source = nullptr;
  std::uint64_t seed = 0;
  int number = 0;  ///< in the whole study
};

/// In the order of their numbers.
std::vector<Job> jobs_of(std::span<const Case> cases, const StudyOptions& options) {
  std::vector<Job> jobs;
  int number = 0;
  for (const Case& source : cases) {
    for (int run = 0; run < options.runs; ++run, ++number) {
      if (number % options.shards == options.shard - 1) {
        jobs.push_back({&source, options.first_seed + static_cast<std::uint64_t>(run), number});
      }
    }
  }
  return jobs;
}

/// Works through the jobs on several threads; each result lies at the index of its job.
class Workers {
 public:
  Workers(std::vector<Job> jobs, const StudyOptions& options,
          const std::function<void(int, int)>& progress, std::optional<StudyStore> store)
      : jobs_(std::move(jobs)),
        options_(options),
        progress_(progress),
        store_(std::move(store)),
        reports_(jobs_.size()) {}

  /// Takes over the operations that the store already holds.
  Status resume() {
    const MutexLock lock(mutex_);
    if (!store_) {
      return {};
    }
    const auto stored = store_->operations();
    if (!stored) {
      return stored.error();
    }
    for (const StoredOperation& operation : *stored) {
      const auto job =
          std::lower_bound(jobs_.begin(), jobs_.end(), operation.index,
                           [](const Job& one, int number) { return one.number < number; });
      if (job == jobs_.end() || job->number != operation.index) {
        continue;  // another shard's
      }
      reports_[static_cast<std::size_t>(job - jobs_.begin())] =
          operation.report.empty() ? Result<std::string>(Error{operation.why})
                                   : Result<std::string>(operation.report);
      ++done_;
    }
    return {};
  }

  Result<Study> run() {
    on_threads(std::min<int>(options_.jobs, static_cast<int>(jobs_.size())), [this] { work(); });
    return keep_and_tell();
  }

  /// Begins no further run and ends the running ones; may be called from any thread.
  void stop() {
    const MutexLock lock(mutex_);
    stop_all();
  }

 private:
  void work() {
    while (true) {
      const std::size_t i = next_++;
      if (i >= jobs_.size() || is_stopped()) {
        return;
      }
      if (is_made(i)) {
        continue;
      }
      OperationOptions operation = options_.operation;
      operation.sim.seed = jobs_[i].seed;
      operation.tracker.parallel = options_.jobs < 2;
      operation.session.live_clearance = false;  // it is not read there
      OperationHooks hooks;
      hooks.can_stop = [this, i](std::function<void()> end) { set_under_way(i, std::move(end)); };
      const auto planned = planned_on(*jobs_[i].source);
      take(i, planned ? run_operation(*jobs_[i].source, *planned, operation, hooks)
                      : Result<OperationResult>(planned.error()));
    }
  }

  bool is_made(std::size_t i) {
    const MutexLock lock(mutex_);
    return reports_[i].has_value();
  }

  /// The plan of a case, with its models prepared once.
  Result<Operation> planned_on(const Case& source) {
    const MutexLock lock(planning_);
    const auto known = plans_.find(&source);
    if (known != plans_.end()) {
      return known->second;
    }
    ModelCache models;
    return plans_.emplace(&source, plan_operation(source, options_.operation.levels, models))
        .first->second;
  }

  void stop_all() ORTHONAV_REQUIRES(mutex_) {
    stopped_ = true;
    for (const auto& [run, end] : under_way_) {
      end();
    }
  }

  Result<Study> keep_and_tell() {
    {
      const MutexLock lock(mutex_);
      if (stored_ && store_ && done_ == static_cast<int>(jobs_.size())) {
        stored_ = store_->finish();
      }
      if (!stored_) {
        return stored_.error();
      }
    }
    return study();
  }

  bool is_stopped() {
    const MutexLock lock(mutex_);
    return stopped_;
  }

  /// Null once it has ended.
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

  /// A run that something other than its operation ended is no result of the method.
  void take(std::size_t i, const Result<OperationResult>& result) {
    const Status ended = result ? result->loop.ended : Status(result.error());
    auto report = ended ? Result<std::string>(report_json(*result)) : ended.error();
    const MutexLock lock(mutex_);
    if (stopped_ && result && !result->completed) {
      return;  // the run may have been ended for that reason
    }
    reports_[i] = std::move(report);
    ++done_;
    if (store_ && stored_.ok()) {
      const Job& job = jobs_[i];
      stored_ = store_->add({job.number, job.source->name, job.seed,
                             ended ? **reports_[i] : std::string(),
                             ended ? std::string() : ended.error().message});
      if (!stored_) {
        stop_all();
      }
    }
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
        continue;  // stopped before it was run
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
    out.text = study_text(method_label(options_.operation), runs, failed, jobs_.size());
    out.made = done_;
    out.planned = static_cast<int>(jobs_.size());
    return out;
  }

  std::vector<Job> jobs_;
  const StudyOptions& options_;
  const std::function<void(int, int)>& progress_;
  std::atomic<std::size_t> next_ = 0;
  mutable Mutex mutex_;
  std::optional<StudyStore> store_ ORTHONAV_GUARDED_BY(mutex_);
  Status stored_ ORTHONAV_GUARDED_BY(mutex_);
  std::vector<std::optional<Result<std::string>>> reports_ ORTHONAV_GUARDED_BY(mutex_);
  Mutex planning_;
  std::map<const Case*, Result<Operation>> plans_ ORTHONAV_GUARDED_BY(planning_);
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
  std::optional<StudyStore> store;
  if (!options.store.empty()) {
    auto opened = StudyStore::open(options.store, definition_of(cases, options));
    if (!opened) {
      return opened.error();
    }
    store = std::move(*opened);
  }
  Workers workers(jobs_of(cases, options), options, progress, std::move(store));
  if (const Status resumed = workers.resume(); !resumed) {
    return resumed.error();
  }
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
