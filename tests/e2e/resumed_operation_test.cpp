// An operation in the simulated room on a patient reference, killed and resumed by another process.
#include <gmock/gmock.h>
#include <unistd.h>

#include <functional>
#include <optional>
#include <tuple>
#include <utility>

#include "engine/case/tool_file.h"
#include "engine/io/posix_env.h"
#include "engine/session/log/operation_log.h"
#include "study/simulated_operation.h"
#include "tests/e2e/planned.h"
#include "tests/support/is_ok.h"
#include "tests/support/killed_process.h"
#include "tests/support/screws_done.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine::resumed_operation_test {
namespace {

using test::is_ok;

/// In the measurement model, with a brisk surgeon: the same work in a tenth of the pairs.
OperationOptions two_levels() {
  OperationOptions options;
  options.measurement = Measurement::kModel;
  options.tools = built_in_tools();
  options.levels = {"L4", "L5"};
  options.use_reference = true;
  options.sim.error_model.pace = 10.0;
  options.loop.draw_every = 0;
  return options;
}

/// Calls a function with each pair.
class EachPair : public LoopObserver {
 public:
  explicit EachPair(std::function<void(const Guidance&)> then) : then_(std::move(then)) {}
  void stepped(const FrameHeader&, const Inputs&, const Guidance& guidance) override {
    then_(guidance);
  }

 private:
  std::function<void(const Guidance&)> then_;
};

OperationIdentity identity_of(const Session& session) {
  return identity_of("phantom", session.levels(), session.tracker().tools(), "best", true);
}

/// A program that begins an operation in the folder, or resumes the one in it.
struct Program {
  explicit Program(const std::string& path) : folder(path) {
    if (auto last = OperationLog::find(env, folder)) {
      before = last->operation;
      records_before = last->operation.records;
      found = std::move(*last);
    }
  }
  Status keep(AssembledOperation& live) {
    const auto waits = RecordWriter::Waits::kUntilDurable;
    const OperationIdentity identity = identity_of(live.session());
    if (found) {
      EXPECT_TRUE(is_ok(check_same(found->operation.identity, identity, found->path)));
      LoggedOperation logged = found->operation;
      logged.reopen();
      if (Status resumed = live.resume(logged); !resumed) {
        return resumed;
      }
      log = OperationLog::reopen(env, *std::exchange(found, std::nullopt), waits);
    } else {
      log = OperationLog::begin(env, folder, identity, live.session().levels(), waits,
                                RecordLog::Earlier::kKept)
                .value();
    }
    live.observe(log.get());
    live.show_saving(log.get());
    return {};
  }
  Result<OperationResult> run(const std::function<void(const Guidance&)>& each_pair) {
    OperationOptions options = two_levels();
    options.reference_places = before.references;
    EachPair pairs([&](const Guidance& guidance) {
      EXPECT_TRUE(guidance.step != Step::kGuide || guidance.levels[guidance.level].usable());
      each_pair(guidance);
    });
    OperationHooks hooks;
    hooks.loop = &pairs;
    hooks.assembled = [this](AssembledOperation& live) { return keep(live); };
    auto result = run_operation(lumbar_spine(), planned(options.levels), options, hooks);
    if (log) {
      EXPECT_TRUE(is_ok(log->finish(result && result->completed, "")));
      log.reset();  // and lets go of the folder
    }
    return result;
  }

  PosixEnv env;
  std::string folder;
  LoggedOperation before;  ///< the operation found in the folder
  std::size_t records_before = 0;

 private:
  std::optional<OperationLog::Found> found;
  std::unique_ptr<OperationLog> log;
};

/// Another process operates until it is killed at that moment. Returns whether the moment came.
bool kill_at(const std::string& folder, const std::function<bool(const Guidance&)>& moment) {
  std::ignore = planned(two_levels().levels);  // for this process too
  return test::kill_after(1, [&](const std::function<void()>& tell) {
    std::ignore = Program(folder).run([&](const Guidance& guidance) {
      if (moment(guidance)) {
        tell();
        ::pause();  // in the middle of a pair
      }
    });
  });
}

/// The index of the first record of that type among those of the second program; their end if there
/// is none.
std::size_t first_of(OperationRecord type, const std::vector<Record>& records, std::size_t from) {
  while (from < records.size() && records[from].type != static_cast<std::uint16_t>(type)) {
    ++from;
  }
  return from;
}

void expect_untouched(const LoggedOperation& was, const LoggedOperation& is) {
  for (std::size_t i = 0; i < was.state.levels.size(); ++i) {
    for (std::size_t screw = 0; screw < was.state.levels[i].screws.size(); ++screw) {
      const ScrewState& before = was.state.levels[i].screws[screw];
      if (before.done && before.executed) {
        EXPECT_EQ(is.state.levels[i].screws[screw].executed->axis.point,
                  before.executed->axis.point)
            << "to the bit";
      }
    }
  }
}

TEST(ResumedOperation, KilledTwiceEndsWithEveryScrewOnceVerifiedBeforeItGuides) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path().string();
  ASSERT_TRUE(kill_at(path, [](const Guidance& g) {
    return g.step == Step::kGuide && g.levels[0].screws[0].done && g.tool;
  })) << "at the second screw";
  const std::size_t first_kill = Program(path).records_before;
  ASSERT_TRUE(kill_at(path, [](const Guidance& g) {
    return g.step == Step::kDigitize && g.level == 1 && g.regions.size() > 2;
  })) << "while the second level is stroked";
  Program last(path);
  ASSERT_TRUE(last.before.state.levels.at(0).finished());
  ASSERT_FALSE(last.before.strokes.at(1).empty());
  const auto result = last.run([](const Guidance&) {});
  ASSERT_TRUE(is_ok(result));
  EXPECT_TRUE(result->completed) << result->why_not;

  const auto found = OperationLog::find(last.env, path);
  ASSERT_TRUE(is_ok(found));
  const std::vector<Record> records = read_log(last.env, found->path).value().records;
  EXPECT_EQ(test::screws_done(records), test::kEveryScrewOnce);
  expect_untouched(last.before, found->operation);
  using enum OperationRecord;
  // In a new room the bone's landmark is elsewhere, so check points verify the restored
  // registration.
  EXPECT_LT(first_of(kLandmark, records, first_kill), first_of(kCheckPoint, records, first_kill));
  EXPECT_LT(first_of(kCheckPoint, records, first_kill), first_of(kAccepted, records, first_kill));
  EXPECT_LT(first_of(kAccepted, records, first_kill), first_of(kScrew, records, first_kill));
  EXPECT_LT(first_of(kAccepted, records, first_kill), first_of(kRegion, records, first_kill))
      << "before anything was stroked again";
  // The second level, of which only strokes were saved, is registered and verified.
  const std::size_t from = last.records_before;
  EXPECT_LT(first_of(kRegistration, records, from), first_of(kCheckPoint, records, from));
  EXPECT_LT(first_of(kCheckPoint, records, from), first_of(kAccepted, records, from));
  EXPECT_LT(first_of(kAccepted, records, from), first_of(kScrew, records, from));
}

}  // namespace
}  // namespace orthonav::engine::resumed_operation_test
