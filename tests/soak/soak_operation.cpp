#include "tests/soak/soak_operation.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/case/tool_file.h"
#include "engine/session/log/operation_log.h"
#include "study/simulated_operation.h"
#include "tests/soak/flaky_env.h"

namespace orthonav::soak {
namespace {

using engine::OperationLog;
using engine::RecordLog;
using engine::RecordWriter;

/// Limit for one attempt: a simulated surgeon who makes no progress would continue for ever.
constexpr Duration kLongest = std::chrono::minutes(45);
constexpr int kMaxResumes = 4;

/// Draws nothing: the drawing thread takes its snapshots all the same.
class Nobody : public engine::SnapshotSink {
 public:
  Status draw(const engine::Snapshot&) override { return {}; }
};

/// Fills the disk for a while, counted in pairs, and notes when "saved" is shown.
class PairWatch : public engine::LoopObserver {
 public:
  PairWatch(FlakyEnv& env, ToldEvents& told, std::int64_t begin, std::int64_t pairs)
      : env_(env), told_(told), begin_(begin), end_(begin + pairs) {}
  void stepped(const FrameHeader& frame, const engine::Inputs&,
               const engine::Guidance& guidance) override {
    env_.set_full(pair_ >= begin_ && pair_ < end_);
    ++pair_;
    first_ = first_ ? first_ : frame.time;
    last_ = frame.time;
    if (guidance.status.saved == engine::Saved::kSaved) {
      told_.saved_is_shown();
    }
  }
  [[nodiscard]] double span_s() const { return first_ ? seconds(last_ - *first_) : 0.0; }

 private:
  FlakyEnv& env_;
  ToldEvents& told_;
  std::int64_t begin_;
  std::int64_t end_;
  std::int64_t pair_ = 0;
  std::optional<Timestamp> first_;
  Timestamp last_{};
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
        pairs_(env_, told_,
               row.full_disk ? static_cast<std::int64_t>(random_.uniform(200, 6000)) : 0,
               row.full_disk ? 300 : 0) {}

  /// Whether the operation reached its end.
  bool run() {
    if (const Status found = find_earlier(); !found) {
      return fail("operation log", found.error());
    }
    engine::OperationHooks hooks;
    hooks.loop = &pairs_;
    hooks.sink = &nobody_;
    hooks.seen_through = [&](Headset& room) -> Result<Headset*> {
      flaky_ = std::make_unique<FlakyHeadset>(room, random_.fork("weather"), chances());
      return flaky_.get();
    };
    hooks.assembled = [&](engine::AssembledOperation& live) { return keep(live); };
    const auto result = engine::run_operation(source_, planned_, options(), hooks);
    const Status ended = result ? result->loop.ended : Status(result.error());
    const bool done = result && result->completed;
    row_.why_not = result ? result->why_not : result.error().message;
    if (!log_) {
      return fail("operation", ended.error());
    }
    row_.stalls += result ? result->loop.stalls : 0;
    if (!ended && device_losses(flaky_->done()) == 0) {
      fail("operation", ended.error());
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
    options.use_reference = row_.reference;
    if (earlier_) {
      options.reference_places = earlier_->operation.references;
    }
    options.sim.seed = row_.seed;
    options.loop.max_time = kLongest;
    options.loop.draw_every = 10;
    return options;
  }
  /// What earlier attempts left, unless they recorded nothing.
  Status find_earlier() {
    if (row_.resumed == 0 || !row_.recorded) {
      return {};
    }
    auto found = OperationLog::find(env_, folder_);
    if (!found) {
      return found.error();
    }
    records_before_ = found->operation.records;
    earlier_ = std::move(*found);
    return {};
  }
  Status keep(engine::AssembledOperation& live) {
    const engine::Session& session = live.session();
    const auto waits = RecordWriter::Waits::kUntilDurable;
    if (!earlier_) {
      auto begun = OperationLog::begin(
          env_, folder_,
          engine::identity_of(source_.name, session.levels(), session.tracker().tools(), "best",
                              row_.reference),
          session.levels(), waits, RecordLog::Earlier::kReplaced);
      if (!begun) {
        return begun.error();
      }
      log_ = std::move(*begun);
    } else {
      engine::LoggedOperation logged = earlier_->operation;
      logged.reopen();
      if (const Status restored = live.resume(logged); !restored) {
        return restored;
      }
      log_ = OperationLog::reopen(env_, *std::exchange(earlier_, std::nullopt), waits);
    }
    live.observe(&told_);
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
    if (!found && found.error().code != ErrorCode::kNotFound) {
      fail("operation log", found.error());
      return;
    }
    std::vector<engine::Record> records;
    // A log in which nothing was recorded goes away with its program.
    if (found) {
      auto read = engine::read_log(env_, found->path);
      if (!read) {
        fail("operation log", read.error());
        return;
      }
      records = std::move(read->records);
    }
    row_.recorded = row_.recorded || found.ok();
    compare(records, saved.ok());
  }
  /// Compares the events of this attempt with the records that it added to the log.
  void compare(std::span<const engine::Record> records, bool saved) {
    const auto added =
        kept_events(records.subspan(std::min<std::size_t>(records_before_, records.size())));
    // Events after the disk failed may be lost, but none for which "saved" was shown.
    const Differences must = differences(saved ? told_.all() : told_.shown_saved(), added);
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
      row_.lost[kind] += must.lost[kind];
    }
    row_.lost_samples += must.lost_samples;
    row_.doubled += differences(told_.all(), added).doubled;
    row_.unsaved += static_cast<std::int64_t>(told_.all().size() - added.size());
    const auto kept = kept_events(records);
    row_.kept = counts_of(kept);
    row_.samples = samples_of(kept);
    row_.twice = screws_done_twice(records);
  }

  const engine::Case& source_;
  const engine::Operation& planned_;
  SoakRow& row_;
  std::string folder_;
  Random random_;
  FlakyEnv env_;
  ToldEvents told_;
  PairWatch pairs_;
  Nobody nobody_;
  std::unique_ptr<FlakyHeadset> flaky_;
  std::optional<OperationLog::Found> earlier_;  ///< until it is gone on with
  std::size_t records_before_ = 0;
  std::unique_ptr<OperationLog> log_;
};

}  // namespace

SoakRow soak_operation(const engine::Case& source, const engine::Operation& planned,
                       std::uint64_t seed, const std::string& folder) {
  SoakRow row;
  row.seed = seed;
  row.full_disk = Random(seed).fork("disk").uniform() < 0.2;
  row.reference = Random(seed).fork("reference").uniform() < 0.5;
  for (;;) {
    const std::int64_t losses = device_losses(row.troubles);
    row.completed = Attempt(source, planned, row, folder).run();
    const bool lost_device = device_losses(row.troubles) > losses;
    if (row.completed || !lost_device || !row.trouble.empty() || row.resumed >= kMaxResumes) {
      return row;
    }
    ++row.resumed;
  }
}

}  // namespace orthonav::soak
