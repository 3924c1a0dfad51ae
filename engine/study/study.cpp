#include "engine/study/study.h"

#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "base/mutex.h"
#include "engine/report/paper_table.h"
#include "nav/evaluation/errors.h"

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

/// The five rows of the table, each over every run that has a value for it.
Json table_of(const Json& runs) {
  Json table = Json::array();
  for (const PaperRow& row : kPaperTable) {
    std::vector<double> values;
    for (const Json& run : runs) {
      const auto measured = values_of(nlohmann::json(run), row);
      values.insert(values.end(), measured.begin(), measured.end());
    }
    const nav::Summary summary = nav::summarize(values);
    table.push_back(Json{{"name", row.name},
                         {"unit", row.unit},
                         {"count", summary.count},
                         {"mean", summary.mean},
                         {"sd", summary.sd},
                         {"min", summary.min},
                         {"max", summary.max},
                         {"paper_mean", row.mean},
                         {"paper_sd", row.sd}});
  }
  return table;
}

std::string study_text(const std::string& method, const Json& runs, const Json& failed) {
  int completed = 0;
  for (const Json& run : runs) {
    completed += run.value("completed", false) ? 1 : 0;
  }
  Json study{{"method", method},
             {"operations", runs.size()},
             {"completed", completed},
             {"table", table_of(runs)},
             {"runs", runs}};
  if (!failed.empty()) {
    study["failed"] = failed;
  }
  return study.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Works through the jobs on several threads; each result lies at the index of its job.
class Workers {
 public:
  Workers(std::vector<Job> jobs, const StudyOptions& options,
          const std::function<void(int, int)>& progress)
      : jobs_(std::move(jobs)),
        options_(options),
        progress_(progress),
        reports_(jobs_.size(), std::string()) {}

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

 private:
  void work() {
    while (true) {
      const std::size_t i = next_++;
      if (i >= jobs_.size()) {
        return;
      }
      OperationOptions operation = options_.operation;
      operation.sim.seed = jobs_[i].seed;
      operation.tracker.parallel = options_.jobs < 2;
      const auto result = run_operation(*jobs_[i].source, operation);
      const MutexLock lock(mutex_);
      if (result) {
        reports_[i] = report_json(*result);
      } else {
        reports_[i] = result.error();
      }
      ++done_;
      if (progress_) {
        progress_(done_, static_cast<int>(jobs_.size()));
      }
    }
  }

  [[nodiscard]] Result<Study> study() const {
    Study out;
    Json runs = Json::array();
    Json failed = Json::array();
    const MutexLock lock(mutex_);
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (reports_[i]) {
        runs.push_back(Json::parse(*reports_[i]));
        continue;
      }
      const std::string& name = jobs_[i].source->name;
      const std::string& why = reports_[i].error().message;
      failed.push_back(Json{{"case", name}, {"seed", jobs_[i].seed}, {"why", why}});
      if (!out.failure) {
        out.failure =
            Error{"case '" + name + "', seed " + std::to_string(jobs_[i].seed) + ": " + why};
      }
    }
    if (runs.empty() && out.failure) {
      return *out.failure;
    }
    out.text = study_text(options_.operation.method, runs, failed);
    return out;
  }

  std::vector<Job> jobs_;
  const StudyOptions& options_;
  const std::function<void(int, int)>& progress_;
  std::atomic<std::size_t> next_ = 0;
  mutable Mutex mutex_;
  std::vector<Result<std::string>> reports_ ORTHONAV_GUARDED_BY(mutex_);
  int done_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

Status check_run(const Json& run, const std::string& name) {
  const bool whole = run.is_object() && run.contains("case") && run["case"].is_string() &&
                     run.contains("seed") && run["seed"].is_number_unsigned() &&
                     run.contains("levels") && run["levels"].is_array();
  if (!whole) {
    return Error{name + ": a run lacks case, seed or levels"};
  }
  if (run.contains("completed") && !run["completed"].is_boolean()) {
    return Error{name + ": completed of a run is " + run["completed"].dump() +
                 ", must be true or false"};
  }
  for (const Json& level : run["levels"]) {
    if (!level.is_object()) {
      return Error{name + ": a level of a run is no object"};
    }
  }
  return {};
}

Status append_runs(const std::string& text, const std::string& name, std::string& method,
                   std::set<std::pair<std::string, std::uint64_t>>& seen, Json& runs,
                   Json& failed) {
  const Json study = Json::parse(text, nullptr, false);
  if (study.is_discarded() || !study.is_object() || !study.contains("runs") ||
      !study["runs"].is_array() || !study.contains("method") || !study["method"].is_string()) {
    return Error{name + ": is no study (an object with method and runs)"};
  }
  const std::string here = study["method"];
  if (!method.empty() && method != here) {
    return Error{name + ": method '" + here + "', the others have '" + method + "'"};
  }
  method = here;
  for (const Json& run : study["runs"]) {
    if (const Status good = check_run(run, name); !good) {
      return good;
    }
    const std::pair key(run["case"].get<std::string>(), run["seed"].get<std::uint64_t>());
    if (!seen.insert(key).second) {
      return Error{name + ": case '" + key.first + "' with seed " + std::to_string(key.second) +
                   " occurs twice"};
    }
    runs.push_back(run);
  }
  if (study.contains("failed") && study["failed"].is_array()) {
    for (const Json& run : study["failed"]) {
      failed.push_back(run);
    }
  }
  return {};
}

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
                        const std::function<void(int, int)>& progress) {
  const auto problems = options.check();
  if (!problems.empty()) {
    return Error{problems.front()};
  }
  if (cases.empty()) {
    return Error{"study: no case"};
  }
  return Workers(jobs_of(cases, options), options, progress).run();
}

Result<std::string> merge_studies(std::span<const std::string> texts,
                                  std::span<const std::string> names) {
  std::string method;
  std::set<std::pair<std::string, std::uint64_t>> seen;
  Json runs = Json::array();
  Json failed = Json::array();
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (const Status read = append_runs(texts[i], names[i], method, seen, runs, failed); !read) {
      return read.error();
    }
  }
  std::stable_sort(runs.begin(), runs.end(), [](const Json& a, const Json& b) {
    const auto key = [](const Json& run) {
      return std::pair(run["case"].get<std::string>(), run["seed"].get<std::uint64_t>());
    };
    return key(a) < key(b);
  });
  return study_text(method, runs, failed);
}

}  // namespace orthonav::engine
