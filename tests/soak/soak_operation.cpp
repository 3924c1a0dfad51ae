#include "tests/soak/soak_operation.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "engine/case/tool_file.h"
#include "engine/session/journal.h"
#include "engine/session/journal_reader.h"
#include "engine/session/operation_log.h"
#include "engine/study/simulated_operation.h"
#include "tests/soak/flaky_env.h"

namespace orthonav::soak {
namespace {

using engine::OperationLog;
using engine::RecordLog;
using engine::RecordWriter;

/// For one attempt: a simulated surgeon who gets nowhere would go on for ever.
constexpr Duration kLongest = std::chrono::minutes(45);
constexpr int kMostResumes = 4;

std::int64_t screws_done(std::span<const engine::LevelState> levels) {
  std::int64_t done = 0;
  for (const engine::LevelState& level : levels) {
    done += std::count(level.screw_done.begin(), level.screw_done.end(), true);
  }
  return done;
}

std::int64_t screws_done(const engine::LoggedOperation& logged) {
  std::int64_t done = 0;
  for (const engine::LoggedLevel& level : logged.levels) {
    done += std::count_if(level.screws.begin(), level.screws.end(),
                          [](const engine::LoggedScrew& screw) { return screw.done; });
  }
  return done;
}

/// Draws nothing: the drawing thread takes its snapshots all the same.
class Nobody : public engine::SnapshotSink {
 public:
  Status draw(const engine::Snapshot&) override { return {}; }
};

/// Fills the disk for a while, counted in pairs, and keeps what was known at the last pair.
class PairWatch : public engine::LoopObserver {
 public:
  PairWatch(FlakyEnv& env, std::int64_t begin, std::int64_t pairs)
      : env_(env), begin_(begin), end_(begin + pairs) {}
  void stepped(const StereoFrame& frame, const engine::Inputs&,
               const engine::Guidance& guidance) override {
    env_.set_full(pair_ >= begin_ && pair_ < end_);
    ++pair_;
    first_ = first_ ? first_ : frame.time;
    last_ = frame.time;
    screws_ = screws_done(guidance.levels);
  }
  [[nodiscard]] double span_s() const { return first_ ? seconds(last_ - *first_) : 0.0; }
  [[nodiscard]] std::int64_t screws() const { return screws_; }

 private:
  FlakyEnv& env_;
  std::int64_t begin_;
  std::int64_t end_;
  std::int64_t pair_ = 0;
  std::optional<Timestamp> first_;
  Timestamp last_{};
  std::int64_t screws_ = 0;
};

/// One run of the program: until the operation ends or the device is lost.
class Attempt {
 public:
  Attempt(const engine::Case& source, const engine::Operation& planned, SoakRow& row,
          std::string folder)
      : source_(source),
        planned_(planned),
        row_(row),
        folder_(std::move(folder)),
        random_(Random(row.seed).fork("attempt").fork(static_cast<std::uint64_t>(row.resumed))),
        pairs_(env_, row.full_disk ? static_cast<std::int64_t>(random_.uniform(200, 6000)) : 0,
               row.full_disk ? 300 : 0) {}

  /// Whether the operation reached its end.
  bool run() {
    const std::string journal_path = folder_ + "/session.orthonav";
    engine::JournalHeader header{"soak", "sim:", "best", source_.name, row_.seed, 0, {}};
    auto journal = engine::Journal::create(journal_path, header);
    if (!journal) {
      return fail("journal", journal.error());
    }
    engine::OperationHooks hooks;
    hooks.session = {journal->get()};
    hooks.loop = &pairs_;
    hooks.sink = &nobody_;
    hooks.seen_through = [&](Headset& room) -> Result<Headset*> {
      flaky_ = std::make_unique<FlakyHeadset>(room, random_.fork("weather"), chances());
      return flaky_.get();
    };
    hooks.assembled = [&](engine::AssembledOperation& live) { return keep(live); };
    const auto result = engine::run_operation(source_, planned_, options(), hooks);
    const bool done = result && result->completed;
    row_.why_not = result ? result->why_not : result.error().message;
    if (!log_) {
      return fail("operation", result.error());
    }
    row_.stalls += result ? result->loop.stalls : 0;
    if (!result && device_losses(flaky_->done()) == 0) {
      fail("operation", result.error());
    }
    if (const Status closed = (*journal)->finish({}); !closed) {
      fail("journal", closed.error());
    }
    if (const auto read = engine::read_journal(journal_path); !read) {
      fail("journal", read.error());
    }
    add_weather();
    check_log(done);
    return done;
  }

 private:
  bool fail(const std::string& what, const Error& error) {
    row_.trouble = what + ": " + error.message;
    return false;
  }
  Chances chances() {
    Chances chances;
    chances.map_jump = random_.uniform() < 0.3 ? 1.0 / 6000.0 : 0.0;
    chances.device_loss = random_.uniform() < 0.4 ? 1.0 / 5000.0 : 0.0;
    return chances;
  }
  engine::OperationOptions options() const {
    engine::OperationOptions options;
    options.measurement = engine::Measurement::kModel;
    options.tools = engine::built_in_tools();
    options.sim.seed = row_.seed;
    options.loop.max_time = kLongest;
    options.loop.draw_every = 10;
    return options;
  }
  Status keep(engine::AssembledOperation& live) {
    const engine::Session& session = live.session();
    const auto waits = RecordWriter::Waits::kUntilDurable;
    if (row_.resumed == 0 || !row_.recorded) {
      auto begun =
          OperationLog::begin(env_, folder_,
                              engine::identity_of(source_.name, session.levels(),
                                                  session.tracker().tools(), "best", false),
                              session.levels(), waits, RecordLog::Earlier::kReplaced);
      if (!begun) {
        return begun.error();
      }
      log_ = std::move(*begun);
    } else {
      auto found = OperationLog::find(env_, folder_);
      if (!found) {
        return found.error();
      }
      engine::LoggedOperation logged = found->operation;
      logged.go_on();
      if (const Status restored = live.resume(logged); !restored) {
        return restored;
      }
      log_ = OperationLog::go_on(env_, std::move(*found), waits);
    }
    live.observe(log_.get());
    live.show_saving(log_.get());
    return {};
  }
  void add_weather() {
    for (std::size_t i = 0; i < row_.troubles.size(); ++i) {
      row_.troubles[i] += flaky_->done()[i];
    }
    row_.frames += flaky_->frames();
    row_.stale += flaky_->stale_frames();
    row_.simulated_s += pairs_.span_s();
  }
  void check_log(bool done) {
    env_.set_full(false);
    const std::int64_t screws = pairs_.screws();
    const Status saved = log_->written();
    const bool said = log_->saved(Timestamp::max(), {}) == engine::Saved::kNotSaved;
    row_.not_saved = row_.not_saved || !saved;
    if (!saved && !said) {
      row_.trouble = "the disk failed and nobody was told";
    }
    if (saved && done) {
      (void)log_->finish(true, "");
    }
    log_.reset();
    const auto found = OperationLog::find(env_, folder_);
    // A log in which nothing was recorded goes away with its program.
    if (!found && found.error().code == ErrorCode::kNotFound && !row_.recorded && screws == 0) {
      return;
    }
    if (!found) {
      fail("operation log", found.error());
      return;
    }
    row_.recorded = true;
    const std::int64_t kept = screws_done(found->operation);
    // What came after NOT SAVED was shown may be gone.
    row_.lost += saved ? std::max<std::int64_t>(screws - kept, 0) : 0;
    row_.screws = std::max(kept, screws);
  }

  const engine::Case& source_;
  const engine::Operation& planned_;
  SoakRow& row_;
  std::string folder_;
  Random random_;
  FlakyEnv env_;
  PairWatch pairs_;
  Nobody nobody_;
  std::unique_ptr<FlakyHeadset> flaky_;
  std::unique_ptr<OperationLog> log_;
};

}  // namespace

SoakRow soak_operation(const engine::Case& source, const engine::Operation& planned,
                       std::uint64_t seed, const std::string& folder) {
  SoakRow row;
  row.seed = seed;
  row.full_disk = Random(seed).fork("disk").uniform() < 0.2;
  for (;;) {
    const std::int64_t losses = device_losses(row.troubles);
    row.completed = Attempt(source, planned, row, folder).run();
    const bool lost_device = device_losses(row.troubles) > losses;
    if (row.completed || !lost_device || !row.trouble.empty() || row.resumed >= kMostResumes) {
      return row;
    }
    ++row.resumed;
  }
}

}  // namespace orthonav::soak
