#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "engine/case/operation_plan.h"
#include "engine/io/atomic_file.h"
#include "engine/io/json_document.h"
#include "engine/io/video_writer.h"
#include "study/sim_scenario.h"
#include "study/simulated_operation.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/demo/demo_arguments.h"
#include "tools/orthonav/demo/earlier_results.h"
#include "tools/orthonav/demo/reading_curves.h"
#include "tools/orthonav/operation/demo_report.h"
#include "tools/orthonav/operation/kept_operation.h"
#include "tools/orthonav/operation/operation_summary.h"
#include "tools/orthonav/operation/progress.h"
#include "tools/orthonav/operation/recording_watch.h"
#include "tools/orthonav/operation/run_files.h"
#include "tools/orthonav/operation/step_pictures.h"
#include "tools/orthonav/operation/stopped_run.h"
#include "tools/orthonav/operation/surgeon_view.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/disk_space.h"
#include "tools/orthonav/shared/memory_reserve.h"
#include "tools/orthonav/shared/out_folder.h"

namespace orthonav::tools {
namespace {

namespace fs = std::filesystem;

/// Frames of the film in a second.
constexpr int kVideoRate = 20;

constexpr const char* kTouchesHeads =
    "The screws of the plan stand in the bones, exactly as planned; nothing that navigates knows "
    "where. The surgeon touches their heads with the pointer, one after the other.";

/// Everything that a demo needs besides the operation itself; created before anything is written.
class Demo {
 public:
  Demo(DemoArguments arguments, StopSignals& signals)
      : arguments_(std::move(arguments)),
        set_up_(arguments_.set_up.chosen()),
        signals_(signals),
        pictures_(arguments_.out) {
    signals_.let_finish();
    signals_.outlast_terminal();
    limit_memory();
  }

  int run() {
    const auto method = engine::method_named(set_up_.method);
    if (!method) {
      return bad_input(method.error().message);
    }
    if (!arguments_.beside.empty()) {
      auto beside = engine::read_text((fs::path(arguments_.beside) / "report.json").string());
      if (!beside) {
        return bad_input("--beside: " + beside.error().message);
      }
      beside_json_ = std::move(*beside);
    }
    if (arguments_.resume) {
      if (const Status found = kept_.find(arguments_.out); !found) {
        return bad_input(found.error().message);
      }
    }
    const bool rods_only = arguments_.rods.rods_only;
    const auto source = load_checked_case(
        arguments_.case_folder, rods_only ? engine::CaseUse::kRods : engine::CaseUse::kOperation);
    if (!source) {
      return bad_input(source.error().message);
    }
    const auto levels = rods_only ? Result<std::vector<std::string>>(std::vector<std::string>())
                                  : engine::levels_to_operate(*source, arguments_.levels);
    if (!levels) {
      return bad_input("--levels: " + levels.error().message);
    }
    auto options = options_of(arguments_);
    if (!options) {
      return bad_input(options.error().message);
    }
    const Status opened = onlookers_.open(arguments_.onlookers);
    if (const Status ready = opened ? prepare() : opened; !ready) {
      return bad_input(ready.error().message);
    }
    warn_of_space("--record", arguments_.record, recording_bytes(0.0));
    warn_of_space("--out", arguments_.out, kResultBytes + (arguments_.no_video ? 0.0 : kFilmBytes));
    auto result = operate(*source, std::move(*options));
    if (!result) {
      return ended(result.error().message);
    }
    explain_stop(signals_, *result);
    const Status written = write(*result);
    std::fputs(
        arguments_.json ? engine::report_json(*result).c_str() : operation_summary(*result).c_str(),
        stdout);
    if (const Status whole = joined_errors(result->loop.ended, written); !whole) {
      return bad_input(whole.error().message);
    }
    tell_how_it_ended(result->completed);
    return result->completed ? kDone : kNo;
  }

 private:
  void tell_how_it_ended(bool completed) {
    if (signals_.caught()) {
      tell_what_is_kept(signals_, {arguments_.out, arguments_.record});
    } else if (!completed) {
      std::fprintf(stderr, "orthonav: operation incomplete\n");
    }
  }

  /// Anything already written stays, and the log says how the run ended. An operation that
  /// never began leaves nothing.
  int ended(std::string reason) {
    if (!began_) {
      return bad_input(reason);
    }
    if (const Status done = pictures_.finish(); !done) {
      reason += "; " + done.error().message;
    }
    if (video_) {
      if (const Status done = video_->finish(); !done) {
        reason += "; " + done.error().message;
      }
    }
    if (const Status done = kept_.finish(false, reason); !done) {
      reason += "; " + done.error().message;
    }
    return bad_input(reason);
  }

  Status prepare() {
    SurgeonViewOptions view_options;
    view_options.device = arguments_.device;
    auto view = SurgeonView::create(view_options);
    if (!view) {
      return view.error();
    }
    view_ = std::move(*view);
    auto out = OutFolder::create("--out", arguments_.out);
    if (!out) {
      return out.error();
    }
    out_.emplace(std::move(*out));
    if (const Status free = kept_.check_free(arguments_.out); !free) {
      return free;
    }
    if (!arguments_.no_video) {
      engine::VideoOptions video_options;
      video_options.width_px = view_options.width_px;
      video_options.height_px = view_options.height_px;
      video_options.frames_per_second = kVideoRate;
      auto video = engine::VideoWriter::create(out_->file("operation.mp4"), video_options);
      if (!video) {
        return video.error();
      }
      video_ = std::move(*video);
      video_pictures_ = std::make_unique<VideoPictures>(*video_);
      view_->send_to(video_pictures_.get());
    }
    view_->send_to(&pictures_);
    view_->send_to(onlookers_.pictures());
    return {};
  }

  Result<engine::OperationResult> operate(const engine::Case& source,
                                          engine::OperationOptions options) {
    options.reference_places = kept_.reference_places();
    OperationProgress progress;
    engine::OperationHooks hooks;
    hooks.sink = view_.get();
    hooks.can_stop = [this](std::function<void()> stop) { signals_.on_stop(std::move(stop)); };
    hooks.seen_through = [this](Headset& room) { return arguments_.calibration.on(room); };
    hooks.assembled = [&](engine::AssembledOperation& operation) {
      operation.observe(view_.get());
      operation.observe(&readings_);
      operation.observe(&progress);
      onlookers_.watch(operation, arguments_.limits.grades());
      return kept_.begin(operation, out_->path().string(), about_demo(arguments_, source.name));
    };
    hooks.recorded = [this](engine::AssembledOperation& operation,
                            const replay::RecordingHeadset& recorder) {
      recording_.watch(operation, recorder, kept_.log());
    };
    hooks.opened = [&](sim::SimHeadset& headset, const engine::Method&, const engine::Session&) {
      view_->look_at(headset, options.sim.error_model);
      onlookers_.look_through(headset.cameras()->calibration());
      began_ = true;
      return arguments_.resume ? Status() : remove_earlier_results(out_->path());
    };
    auto result = engine::run_operation(source, options, hooks);
    if (result) {
      result->instrument = set_up_.instrument;
    }
    onlookers_.ended(result ? result->loop : engine::LoopReport{.ended = result.error()});
    return result;
  }

  /// Writes the measurements first, so that nothing that fails later can lose them. Returns the
  /// first failure.
  Status write(const engine::OperationResult& result) {
    Status first;
    const auto note = [&first](const Status& status) {
      if (first.ok()) {
        first = status;
      }
      return status.ok();
    };
    note(engine::write_file(out_->file("report.json"), engine::report_json(result)));
    note(engine::write_file(out_->file("timing.json"), engine::timing_json(result.loop)));
    note(kept_.finish(result.completed, result.completed ? "" : result.why_not,
                      result.loop.last_frame));
    note(pictures_.finish());
    const bool film = video_ && note(video_->finish());
    const DemoReport report{
        .date = kept_.begun(),
        .perfect = arguments_.perfect,
        .surgeon = arguments_.rods.rods_only ? kTouchesHeads : described(set_up_),
        .video = film,
        .beside_json = beside_json_,
        .beside_page =
            fs::proximate(fs::path(arguments_.beside) / "report.html", out_->path()).string(),
        .plots = readings_.plots(arguments_.limits.grades()),
        .pictures = pictures_.written()};
    note(write_demo_report(out_->path(), result, report));
    note(result.recording);
    return first;
  }

  DemoArguments arguments_;
  engine::SetUp set_up_;
  StopSignals& signals_;
  std::string beside_json_;
  bool began_ = false;            ///< the room is open, the first pair is next
  std::optional<OutFolder> out_;  ///< destroyed last: the files in it are dropped first
  std::unique_ptr<SurgeonView> view_;
  StepPictures pictures_;
  ReadingCurves readings_;
  KeptOperation kept_;
  Onlookers onlookers_;
  RecordingWatch recording_{onlookers_.log()};
  std::unique_ptr<engine::VideoWriter> video_;
  std::unique_ptr<VideoPictures> video_pictures_;
};

}  // namespace

void add_demo_command(CLI::App& app, Action& action, StopSignals& signals) {
  auto arguments = std::make_shared<DemoArguments>();
  auto* demo = app.add_subcommand(
      "demo", "A whole navigated operation in the simulated room, from camera frames to holograms");
  add_demo_arguments(*demo, *arguments);
  demo->callback([arguments, &action, &signals] {
    action = [arguments, &signals] {
      const Status spoken = arguments->wearer.use();
      return spoken ? Demo(*arguments, signals).run() : bad_input(spoken.error().message);
    };
  });
}

}  // namespace orthonav::tools
