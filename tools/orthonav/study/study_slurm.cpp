#include "tools/orthonav/study/study_slurm.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <set>

#include "engine/io/atomic_file.h"
#include "study/study_definition.h"
#include "tools/orthonav/study/study_replay.h"

namespace orthonav::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kOperationsATask = 60;
/// A task that fails this often will not succeed.
constexpr int kRounds = 8;

std::string shard_file(const std::string& folder, int shard) {
  char name[32];
  std::snprintf(name, sizeof name, "shard-%05d.db", shard);
  return (fs::path(folder) / name).string();
}

/// The script of a task: it runs this program for the shard with the task's number.
std::string script_of(const StudyArguments& arguments, int tasks) {
  std::error_code code;
  const std::string command = quoted(fs::read_symlink("/proc/self/exe", code).string()) + " study" +
                              operation_words(arguments, arguments.cases) + " --runs " +
                              std::to_string(arguments.runs) + " --seed " +
                              std::to_string(arguments.first_seed);
  const std::string folder = fs::absolute(arguments.slurm, code).string();
  return "#!/bin/bash\n"
         "# One task: a shard of the study. SIGTERM (preemption) keeps what was made.\n"
         "shard=$(printf '%s/shard-%05d.db' " +
         quoted(folder) + " \"$SLURM_ARRAY_TASK_ID\")\n" + "exec " + command +
         " --jobs \"${SLURM_CPUS_ON_NODE:-1}\" --shard \"$SLURM_ARRAY_TASK_ID/" +
         std::to_string(tasks) + "\" --db \"$shard\" >/dev/null\n";
}

/// Files of shards, whole or growing.
std::vector<std::string> files_of(const std::string& folder, int tasks) {
  std::vector<std::string> files;
  for (int shard = 1; shard <= tasks; ++shard) {
    const std::string file = shard_file(folder, shard);
    std::error_code code;
    for (const std::string& there : {file, file + ".part"}) {
      if (fs::exists(there, code)) {
        files.push_back(there);
        break;
      }
    }
  }
  return files;
}

/// "1-4,7" of numbers in order.
std::string ranges(const std::set<int>& numbers) {
  std::string out;
  for (auto it = numbers.begin(); it != numbers.end();) {
    auto last = it;
    while (std::next(last) != numbers.end() && *std::next(last) == *last + 1) {
      ++last;
    }
    out += (out.empty() ? "" : ",") + std::to_string(*it) +
           (*last > *it ? "-" + std::to_string(*last) : "");
    it = std::next(last);
  }
  return out;
}

/// Shards with operations that are in no file yet.
Result<std::set<int>> unfinished(const std::string& definition, const std::string& folder,
                                 int tasks) {
  const auto missing = engine::missing_operations(definition, files_of(folder, tasks));
  if (!missing) {
    return missing.error();
  }
  std::set<int> shards;
  for (const int number : *missing) {
    shards.insert(number % tasks + 1);
  }
  return shards;
}

/// Runs a command by the shell and waits; -1 when it could not be started.
int shell(const std::string& command) {
  std::string name = "sh";
  std::string flag = "-c";
  std::string text = command;
  std::array<char*, 4> words = {name.data(), flag.data(), text.data(), nullptr};
  pid_t child = 0;
  if (posix_spawn(&child, "/bin/sh", nullptr, nullptr, words.data(), environ) != 0) {
    return -1;
  }
  int answer = 0;
  while (waitpid(child, &answer, 0) < 0) {
    if (errno != EINTR) {
      return -1;
    }
  }
  return answer;
}

/// Whether the shell can find a program.
bool is_there(const std::string& program) {
  return shell("command -v " + quoted(program) + " >/dev/null 2>&1") == 0;
}

Status submit(const std::string& folder, const std::set<int>& shards) {
  const std::string log = (fs::path(folder) / "task-%a.log").string();
  const std::string command =
      "sbatch --wait --requeue --job-name=orthonav-study --array=" + ranges(shards) +
      " --output=" + quoted(log) + " " + quoted((fs::path(folder) / "task.sh").string()) + " 1>&2";
  const int answer = shell(command);
  return answer == -1
             ? Status(Error{"--slurm: sbatch could not be started", ErrorCode::kUnavailable})
             : Status();
}

}  // namespace

int run_on_slurm(const StudyArguments& arguments, std::span<const engine::Case> cases,
                 const engine::StudyOptions& options) {
  const std::string definition = engine::definition_of(cases, options);
  const int planned = options.runs * static_cast<int>(cases.size());
  const int tasks = std::min(
      planned, arguments.slurm_tasks > 0 ? arguments.slurm_tasks : 1 + planned / kOperationsATask);
  std::error_code code;
  fs::create_directories(arguments.slurm, code);
  const std::string script = (fs::path(arguments.slurm) / "task.sh").string();
  if (const Status written = engine::write_file(script, script_of(arguments, tasks)); !written) {
    return bad_input(written.error().message);
  }
  for (int round = 0; round < kRounds; ++round) {
    const auto shards = unfinished(definition, arguments.slurm, tasks);
    if (!shards) {
      return bad_input(shards.error().message);
    }
    if (shards->empty()) {
      return write_joined(arguments.json, arguments.report, files_of(arguments.slurm, tasks),
                          replay_of(arguments, cases));
    }
    if (!is_there("sbatch")) {
      return bad_input("--slurm: sbatch was not found (Debian: slurm-wlm)");
    }
    std::fprintf(stderr, "study: %zu of %d tasks to run\n", shards->size(), tasks);
    if (const Status submitted = submit(arguments.slurm, *shards); !submitted) {
      return bad_input(submitted.error().message);
    }
  }
  std::fprintf(
      stderr,
      "orthonav: after %d rounds there are still operations missing; %s/task-*.log may say "
      "why, what was made is kept\n",
      kRounds, arguments.slurm.c_str());
  return kNo;
}

}  // namespace orthonav::tools
