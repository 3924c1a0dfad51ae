#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "engine/case/model_cache.h"
#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/io/atomic_file.h"
#include "engine/live/presenter.h"
#include "engine/report/operation_result.h"
#include "engine/session/journal.h"
#include "engine/session/observer_list.h"
#include "engine/session/spoken_commands.h"
#include "engine/study/evaluation.h"
#include "engine/study/sim_scenario.h"
#include "engine/study/simulated_operation.h"
#include "hal/hl2ss/hl2ss_headset.h"
#include "hal/open/joined_headset.h"
#include "hal/open/open.h"
#include "hal/open/open_parts.h"
#include "hal/replay/recorder.h"
#include "tools/arguments.h"
#include "tools/case_source.h"
#include "tools/command.h"
#include "tools/connection_report.h"
#include "tools/demo_report.h"
#include "tools/model_notes.h"
#include "tools/operation_summary.h"
#include "tools/out_folder.h"
#include "tools/progress.h"
#include "tools/run_stats.h"

namespace orthonav::tools {
namespace {

struct RunArguments {
  std::string headset = "sim:";
  std::string case_folder;
  std::string method = "best";
  std::vector<std::string> levels;
  std::string tools_file;
  std::string clicker = "headset";
  std::string voice = "headset";
  std::string record;
  std::string out;
  std::int64_t frames = 0;
  bool json = false;
  bool stats = false;
};

/// Opens everything, then runs; members in the order in which they borrow from one another.
class LiveRun {
 public:
  explicit LiveRun(RunArguments arguments) : arguments_(std::move(arguments)) {}

  int run() {
    if (const Status opened = open(); !opened) {
      return bad_input(opened.error().message);
    }
    engine::LoopOptions options;
    options.draw_every = 0;
    options.max_frames = arguments_.frames;
    engine::SceneBuilder builder;
    OperationProgress progress(nullptr);
    if (headset_->pixels()) {
      options.draw_every = 1;
      options.drop_late_snapshots = true;
    }
    engine::FrameLoop loop(*used_, *session_, builder, options);
    loop.observe(&progress);
    if (const Status presenting = present(loop); !presenting) {
      return ended(presenting.error().message);
    }
    auto report = loop.run();
    end_presenting();
    if (!report) {
      return ended(report.error().message);
    }
    engine::OperationResult result =
        engine::outcome_of(session_->levels(), session_->rods(), std::move(*report));
    result.method = method_.name;
    result.case_name = case_name_;
    if (room_) {
      result.seed = room_->options().seed;
    }
    if (ground_truth_) {
      ground_truth_->evaluate(session_->levels(), result);
    }
    end_note_.explain(result);
    if (const Status finished = finish(result); !finished) {
      return bad_input(finished.error().message);
    }
    const bool limited = arguments_.frames > 0 && result.loop.displayed >= arguments_.frames;
    return result.completed || limited ? kDone : kNo;
  }

 private:
  /// What was written until then stays: the journal says how it ended.
  int ended(std::string reason) {
    if (journal_) {
      if (const Status done = journal_->finish(reason); !done) {
        reason += "; " + done.error().message;
      }
    }
    if (recorder_) {
      if (const Status done = recorder_->close(); !done) {
        reason += "; " + done.error().message;
      }
    }
    return bad_input(reason);
  }

  /// Where the headset takes pixels.
  Status present(engine::FrameLoop& loop) {
    if (!headset_->pixels()) {
      return {};
    }
    engine::PresenterOptions options;
    options.on_over = [&loop] { loop.stop(); };
    auto presenter = engine::Presenter::start(*headset_->pixels(), options);
    if (!presenter) {
      return presenter.error();
    }
    presenter_ = std::move(*presenter);
    loop.draw_into(presenter_.get());
    return {};
  }

  void end_presenting() {
    if (!presenter_) {
      return;
    }
    const engine::PresentReport report = presenter_->stop();
    for (const std::string& problem : report.problems) {
      std::fprintf(stderr, "%s\n", problem.c_str());
    }
    if (arguments_.stats) {
      print_stats(report);
    }
  }

  Status open() {
    auto method = engine::method_named(arguments_.method);
    if (!method) {
      return method.error();
    }
    method_ = std::move(*method);
    const auto source = load_checked_case(arguments_.case_folder);
    if (!source) {
      return source.error();
    }
    case_name_ = source->name;
    if (!arguments_.out.empty()) {
      models_ = engine::ModelCache((std::filesystem::path(arguments_.out) / "models").string());
    }
    auto operation = engine::plan_operation(*source, arguments_.levels, models_);
    if (!operation) {
      return operation.error();
    }
    OpenOptions open_options;
    open_options.room = engine::room_of(*source, *operation, engine::built_in_tools());
    auto headset = open_headset(arguments_.headset, open_options);
    if (!headset) {
      return headset.error();
    }
    headset_ = std::move(*headset);
    if (arguments_.headset == "openxr:") {
      std::fprintf(stderr, "openxr: no cameras are named, so the simulated room's: openxr:+sim:\n");
    }
    if (arguments_.headset.ends_with("?pace=step")) {
      return Error{"headset URI \"" + arguments_.headset +
                   "\": nobody steps here; known paces are fast and realtime"};
    }
    if (const Status joined = join_parts(); !joined) {
      return joined;
    }
    return start(std::move(*operation));
  }

  Status join_parts() {
    OtherParts parts;
    auto clicker = open_clicker(arguments_.clicker, headset_->clock());
    if (!clicker) {
      return clicker.error();
    }
    parts.clicker = std::move(*clicker);
    auto voice =
        open_voice(arguments_.voice, engine::spoken_commands(), headset_->clock(), headset_.get());
    if (!voice) {
      return voice.error();
    }
    parts.voice = std::move(*voice);
    joined_ = std::make_unique<JoinedHeadset>(*headset_, std::move(parts));
    return {};
  }

  Status start(engine::Operation operation) {
    const auto tools = arguments_.tools_file.empty()
                           ? engine::tools_known_to(headset_->owner_of_cameras())
                           : engine::load_tools(arguments_.tools_file);
    if (!tools) {
      return tools.error();
    }
    auto tracker = method_.create_tracker(headset_->cameras().calibration(), *tools,
                                          engine::OperationOptions().tracker);
    if (!tracker) {
      return tracker.error();
    }
    auto session = engine::Session::create(std::move(operation), std::move(*tracker), method_);
    if (!session) {
      return session.error();
    }
    session_ = std::move(*session);
    observers_.add(&end_note_);
    room_ = dynamic_cast<const sim::SimHeadset*>(&headset_->owner_of_cameras());
    if (room_) {
      observers_.add(&ground_truth_.emplace(*room_));
    }
    if (const Status opened = open_journal(); !opened) {
      return opened;
    }
    session_->observe(&observers_);
    return start_recording(*tools);
  }

  Status open_journal() {
    if (arguments_.out.empty()) {
      return {};
    }
    auto out = OutFolder::create("--out", arguments_.out);
    if (!out) {
      return out.error();
    }
    out_.emplace(std::move(*out));
    auto journal =
        engine::Journal::create(out_->file("session.orthonav"),
                                {ORTHONAV_VERSION, headset_->name(), method_.name, case_name_,
                                 room_ ? room_->options().seed : 0, headset_->epoch_ticks_100ns()});
    if (!journal) {
      return journal.error();
    }
    journal_ = std::move(*journal);
    observers_.add(journal_.get());
    models_.keep();
    print_notes(models_);
    return {};
  }

  /// Last of all, for a recording that was begun stays.
  Status start_recording(const std::vector<nav::ToolGeometry>& tools) {
    used_ = joined_.get();
    if (arguments_.record.empty()) {
      return {};
    }
    replay::RecorderOptions options;
    options.tools_json = engine::tools_text(tools);
    options.takes_depth = true;
    auto recorder = replay::RecordingHeadset::around(*joined_, arguments_.record, options);
    if (!recorder) {
      return recorder.error();
    }
    recorder_ = std::move(*recorder);
    used_ = recorder_.get();
    return {};
  }

  /// What was measured first: nothing that fails after it may take it away. The first failure.
  Status finish(const engine::OperationResult& result) {
    const std::string report = engine::report_json(result);
    std::fputs(arguments_.json ? report.c_str() : operation_summary(result).c_str(), stdout);
    if (arguments_.stats) {
      print_stats(result.loop);
    }
    if (const auto* connected = dynamic_cast<const hl2ss::Hl2ssHeadset*>(headset_.get());
        connected && arguments_.stats) {
      std::fputs(connection_report(connected->statistics()).c_str(), stderr);
    }
    Status first;
    const auto note = [&first](const Status& status) {
      if (first.ok()) {
        first = status;
      }
    };
    if (out_) {
      note(engine::write_file(out_->file("report.json"), report));
    }
    if (out_) {
      note(write_demo_report(out_->path(), result, {.simulated = room_ != nullptr}));
    }
    if (journal_) {
      note(journal_->finish());
    }
    if (recorder_) {
      note(recorder_->close());
    }
    return first;
  }

  RunArguments arguments_;
  engine::Method method_;
  engine::ModelCache models_;
  std::string case_name_;
  std::unique_ptr<Headset> headset_;
  std::unique_ptr<JoinedHeadset> joined_;  ///< with the clicker and the voice asked for
  std::unique_ptr<replay::RecordingHeadset> recorder_;
  Headset* used_ = nullptr;
  const sim::SimHeadset* room_ = nullptr;  ///< the headset, where it is the simulated one
  std::optional<engine::GroundTruthRecorder> ground_truth_;
  engine::EndNote end_note_;
  std::optional<OutFolder> out_;
  std::unique_ptr<engine::Journal> journal_;
  engine::ObserverList observers_;
  std::unique_ptr<engine::Session> session_;
  std::unique_ptr<engine::Presenter> presenter_;
};

}  // namespace

void add_run_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RunArguments>();
  auto* run = app.add_subcommand("run", "An operation with a headset, simulated or recorded");
  run->add_option("--headset", arguments->headset,
                  "URI: sim:, replay:PATH, hl2ss://HOST, openxr:+URI")
      ->check(some_text())
      ->capture_default_str();
  run->add_option("--clicker", arguments->clicker,
                  "headset, none, evdev:[PATH|NAME] or keyboard:[NAME] (docs/headsets.md)")
      ->check(some_text())
      ->capture_default_str();
  run->add_option("--voice", arguments->voice,
                  "headset, none, mic:[NAME], headset-mic: or wav:FILE (docs/voice.md)")
      ->check(some_text())
      ->capture_default_str();
  run->add_option("--case", arguments->case_folder,
                  "case folder with case.json (default: the built-in phantom)")
      ->check(some_text());
  run->add_option("--method", arguments->method, "best or paper (the published one)")
      ->capture_default_str();
  run->add_option("--levels", arguments->levels, "levels to operate (default: the two lowest)")
      ->delimiter(',');
  run->add_option("--tools", arguments->tools_file,
                  "tool definitions (default: the headset's own, else the built-in)")
      ->check(some_text());
  run->add_option("--frames", arguments->frames, "end after so many displayed frames (0: no limit)")
      ->check(whole_number(0));
  run->add_option("--record", arguments->record, "record the session into this new folder")
      ->check(some_text());
  run->add_option("--out", arguments->out,
                  "folder for report.html, report.json and session.orthonav")
      ->check(some_text());
  run->add_flag("--stats", arguments->stats,
                "print frame intervals, ages from capture to photon and tracking times");
  run->add_flag("--json", arguments->json, "print the report as JSON");
  run->callback(
      [arguments, &action] { action = [arguments] { return LiveRun(*arguments).run(); }; });
}

}  // namespace orthonav::tools
