// How soon an operation is back: the time from the start of `orthonav run --resume` to its first
// pair, with the operation restored. bench_back ORTHONAV [FOLDER] [TIMES, default 20]. The
// operation was killed at its second screw, on a patient reference. Prints a table; nothing is left
// in the folder.

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "bench/quantile.h"
#include "engine/case/tool_file.h"
#include "engine/io/posix_env.h"
#include "engine/phantom/phantom.h"
#include "engine/session/log/operation_log.h"
#include "study/simulated_operation.h"

namespace orthonav {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSeed = 3;

/// Ends the operation at its second screw.
class UntilSecondScrew : public engine::LoopObserver {
 public:
  std::function<void()> stop;
  void stepped(const FrameHeader&, const engine::Inputs&,
               const engine::Guidance& guidance) override {
    if (stop && guidance.step == engine::Step::kGuide && guidance.levels[0].screws[0].done) {
      stop();
    }
  }
};

/// The log of such an operation, from the measurement model, as `run` would have left it.
Status operate(const std::string& folder) {
  engine::PosixEnv env;
  std::unique_ptr<engine::OperationLog> log;
  UntilSecondScrew until;
  engine::OperationOptions options;
  options.measurement = engine::Measurement::kModel;
  options.tools = engine::built_in_tools();
  options.levels = {"L4", "L5"};
  options.use_reference = true;
  options.sim.seed = kSeed;
  options.loop.draw_every = 0;
  engine::OperationHooks hooks;
  hooks.loop = &until;
  hooks.can_stop = [&](std::function<void()> stop) { until.stop = std::move(stop); };
  hooks.assembled = [&](engine::AssembledOperation& live) -> Status {
    const engine::Session& session = live.session();
    engine::OperationIdentity identity =
        engine::identity_of("phantom", session.levels(), session.tracker().tools(), "best", true);
    identity.room = "seed " + std::to_string(kSeed);
    auto begun = engine::OperationLog::begin(env, folder, identity, session.levels(),
                                             engine::RecordWriter::Waits::kUntilDurable,
                                             engine::RecordLog::Earlier::kKept);
    if (!begun) {
      return begun.error();
    }
    log = std::move(*begun);
    live.observe(log.get());
    return {};
  };
  const auto result = engine::run_operation(engine::phantom(), options, hooks);
  return result ? log->finish(false, "killed") : Status(result.error());
}

/// Reads the command's output until it reports its first pair. Returns all of it.
std::string said_until_first_pair(int from) {
  std::string said;
  std::array<char, 4096> room{};
  for (;;) {
    const ssize_t count = ::read(from, room.data(), room.size());
    if (count <= 0) {
      return said;
    }
    said.append(room.data(), static_cast<std::size_t>(count));
    if (said.find("%  setup") != std::string::npos) {
      return said;
    }
  }
}

/// Milliseconds; negative: it did not resume.
double time_back_ms(const std::string& orthonav, const std::string& folder) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) {
    return -1.0;
  }
  const std::string headset = "sim:?seed=" + std::to_string(kSeed);
  const Stopwatch watch;
  const pid_t child = ::fork();
  if (child < 0) {
    return -1.0;
  }
  if (child == 0) {
    ::dup2(pipe[1], STDERR_FILENO);
    ::execl(orthonav.c_str(), "orthonav", "run", "--headset", headset.c_str(), "--levels", "L4,L5",
            "--reference", "--out", folder.c_str(), "--resume", nullptr);
    ::_exit(2);
  }
  ::close(pipe[1]);
  const std::string said = said_until_first_pair(pipe[0]);
  const double took_ms = watch.elapsed_ms();
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(pipe[0]);
  if (said.find("orthonav: placed: L4 left") == std::string::npos) {
    std::fputs(said.c_str(), stderr);
    return -1.0;
  }
  return took_ms;
}

int measure(const std::string& orthonav, const fs::path& folder, int times) {
  fs::create_directories(folder);
  if (const Status operated = operate(folder.string()); !operated) {
    std::fprintf(stderr, "bench_back: %s\n", operated.error().message.c_str());
    return 1;
  }
  std::vector<double> back_ms;
  for (int i = 0; i < times; ++i) {
    back_ms.push_back(time_back_ms(orthonav, folder.string()));
  }
  fs::remove_all(folder);
  if (quantile(back_ms, 0.0) < 0.0) {
    return 1;
  }
  // With fewer than a hundred runs, the 99th percentile is the longest one.
  const double p99_ms = quantile(back_ms, back_ms.size() < 100 ? 1.0 : 0.99);
  std::printf("back, from start to the first pair           %5zu  median %.2f s  p99 %.2f s\n",
              back_ms.size(), quantile(back_ms, 0.5) / 1e3, p99_ms / 1e3);
  return 0;
}

}  // namespace
}  // namespace orthonav

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("usage: bench_back ORTHONAV [FOLDER] [TIMES]\n", stderr);
    return 2;
  }
  const std::filesystem::path folder =
      std::filesystem::path(argc > 2 ? argv[2] : ".") / "bench-back";
  return orthonav::measure(argv[1], folder, argc > 3 ? std::atoi(argv[3]) : 20);
}
