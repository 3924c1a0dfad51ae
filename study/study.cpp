#include "study/study.h"

#include <algorithm>
#include <atomic>
#include <map>
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
          const std::function<void(int, int)>& progress, StudyStore store)
      : jobs_(std::move(jobs)),
        options_(options),
        progress_(progress),
        store_(std::move(store)),
        is_made_(jobs_.size()) {}

  /// Takes over the operations that the store already holds.
  Status resume() {
    const MutexLock lock(mutex_);
    return store_.for_each([this](const StoredOperation& operation) ORTHONAV_REQUIRES(mutex_) {
      const auto job =
          std::lower_bound(jobs_.begin(), jobs_.end(), operation.index,
                           [](const Job& one, int number) { return one.number < number; });
      if (job != jobs_.end() && job->number == operation.index) {  // otherwise another shard's
        note(static_cast<std::size_t>(job - jobs_.begin()), operation);
      }
      return Status();
    });
  }

  Result<Study> run() {
    on_threads(std::min<int>(options_.jobs, static_cast<int>(jobs_.size())), [this] { work(); });
    const MutexLock lock(mutex_);
    if (!stored_) {
      return stored_.error();
    }
    auto text = study_text(store_, options_.shard, options_.shards);
    if (!text) {
      return text.error();
    }
    if (done_ == static_cast<int>(jobs_.size())) {
      if (Status finished = store_.finish(); !finished) {
        return finished.error();
      }
    }
    if (first_failed_ && failed_ == done_) {
      return first_failed_->second;
    }
    Study out{std::move(*text), {}, done_, static_cast<int>(jobs_.size())};
    if (first_failed_) {
      out.failure = first_failed_->second;
    }
    return out;
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
    return is_made_[i];
  }

  void note(std::size_t i, const StoredOperation& operation) ORTHONAV_REQUIRES(mutex_) {
    is_made_[i] = true;
    ++done_;
    failed_ += operation.report.empty() ? 1 : 0;
    if (operation.report.empty() && (!first_failed_ || i < first_failed_->first)) {
      first_failed_ = {i, Error{"case '" + operation.case_name + "', seed " +
                                std::to_string(operation.seed) + ": " + operation.why}};
    }
  }

  /// The plan of a case, with its models prepared once.
  Result<Operation> planned_on(const Case& source) {
    const MutexLock lock(planning_);
    const auto known = plans_.find(&source);
    if (known != plans_.end()) {
      return known->second;
    }
    return plans_.emplace(&source, plan_operation(source, options_.operation.levels)).first->second;
  }

  void stop_all() ORTHONAV_REQUIRES(mutex_) {
    stopped_ = true;
    for (const auto& [run, end] : under_way_) {
      end();
    }
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
    const Job& job = jobs_[i];
    const StoredOperation made{job.number, job.source->name, job.seed,
                               ended ? report_json(*result) : std::string(),
                               ended ? std::string() : ended.error().message};
    const MutexLock lock(mutex_);
    if (stopped_ && result && !result->completed) {
      return;  // the run may have been ended for that reason
    }
    note(i, made);
    if (stored_.ok()) {
      stored_ = store_.add(made);
      if (!stored_) {
        stop_all();
      }
    }
    if (progress_) {
      progress_(done_, static_cast<int>(jobs_.size()));
    }
  }

  std::vector<Job> jobs_;
  const StudyOptions& options_;
  const std::function<void(int, int)>& progress_;
  std::atomic<std::size_t> next_ = 0;
  mutable Mutex mutex_;
  StudyStore store_ ORTHONAV_GUARDED_BY(mutex_);
  Status stored_ ORTHONAV_GUARDED_BY(mutex_);
  std::vector<bool> is_made_ ORTHONAV_GUARDED_BY(mutex_);
  Mutex planning_;
  std::map<const Case*, Result<Operation>> plans_ ORTHONAV_GUARDED_BY(planning_);
  std::map<std::size_t, std::function<void()>> under_way_ ORTHONAV_GUARDED_BY(mutex_);
  bool stopped_ ORTHONAV_GUARDED_BY(mutex_) = false;
  int done_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  int failed_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::optional<std::pair<std::size_t, Error>> first_failed_ ORTHONAV_GUARDED_BY(mutex_);
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
  auto store = StudyStore::open(options.store, definition_of(cases, options));
  if (!store) {
    return store.error();
  }
  Workers workers(jobs_of(cases, options), options, progress, std::move(*store));
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
