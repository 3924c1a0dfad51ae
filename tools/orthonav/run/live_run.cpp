#include "tools/orthonav/run/live_run.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/live/assembled_operation.h"
#include "engine/live/known_tools.h"
#include "engine/report/operation_result.h"
#include "engine/session/workflow/commands.h"
#include "hal/open/open.h"
#include "study/evaluation.h"
#include "study/sim_scenario.h"
#include "study/surgeon/written_frame.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/operation/operation_summary.h"
#include "tools/orthonav/operation/progress.h"
#include "tools/orthonav/operation/run_files.h"
#include "tools/orthonav/operation/stopped_run.h"
#include "tools/orthonav/run/connection_report.h"
#include "tools/orthonav/run/joined_parts.h"
#include "tools/orthonav/run/presenting.h"
#include "tools/orthonav/run/run_stats.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/disk_space.h"
#include "tools/orthonav/shared/memory_reserve.h"
#include "tools/orthonav/shared/print_text.h"
#include "tools/orthonav/shared/recorded_pairs.h"

namespace orthonav::tools {
namespace {

/// Opens everything, then runs; members are in the order in which they borrow from one another.
class LiveRun {
 public:
  LiveRun(RunArguments arguments, StopSignals& signals)
      : arguments_(std::move(arguments)),
        set_up_(chosen_for(arguments_.set_up, arguments_.headset)),
        signals_(signals) {
    signals_.let_finish();
    signals_.outlast_terminal();
    limit_memory();
  }

  int run() {
    if (const Status opened = open(); !opened) {
      return bad_input(opened.error().message);
    }
    OperationProgress progress;
    operation_->observe(&progress);
    onlookers_.watch(*operation_, arguments_.limits.grades());
    if (const Status presenting = presenting_.begin(*headset_, *operation_); !presenting) {
      return bad_input(files_.close(presenting.error().message));
    }
    onlookers_.draw_over_camera(*operation_, joined_->cameras(), presenting_.sink());
    signals_.on_stop([this] { operation_->stop(); });
    engine::LoopReport report = operation_->run();
    signals_.on_stop(nullptr);
    progress.end();
    presenting_.end(arguments_.stats);
    onlookers_.ended(report);
    const engine::OperationResult result = result_of(std::move(report));
    const std::string text = engine::report_json(result);
    const Status kept = files_.finish(result, text, room_ != nullptr);
    // The files are on the disk before a terminal that is not read can hold this up.
    std::fputs(arguments_.json ? text.c_str() : operation_summary(result).c_str(), stdout);
    print_figures(result.loop);
    warn_of_never_seen(operation_->session().tracker());
    if (const Status whole = joined_errors(result.loop.ended, kept); !whole) {
      return bad_input(whole.error().message);
    }
    tell_what_is_kept(signals_, {arguments_.out, arguments_.record});
    const bool enough = arguments_.frames > 0 && result.loop.displayed >= arguments_.frames;
    const bool limited = (arguments_.for_s > 0.0 || enough) && !signals_.caught();
    return result.completed || limited ? kDone : kNo;
  }

 private:
  engine::OperationResult result_of(engine::LoopReport report) {
    const auto& session = operation_->session();
    engine::OperationResult result = engine::result_of(session.operation(), std::move(report));
    result.method = method_.name;
    result.case_name = case_name_;
    result.patient_reference = set_up_.reference;
    result.errors = operation_->errors();
    result.calibration = engine::calibration_in_use(session.tracker());
    result.seed = room_ ? std::optional(room_->options().seed) : std::nullopt;
    if (ground_truth_) {
      ground_truth_->evaluate(result);
    }
    result.recorded = files_.end_recording();
    end_note_.explain(result);
    explain_stop(signals_, result);
    return result;
  }

  Status open() {
    auto method = engine::method_named(set_up_.method);
    if (!method) {
      return method.error();
    }
    method_ = std::move(*method);
    if (const Status good = check_arguments(); !good) {
      return good;
    }
    const bool rods_only = arguments_.rods.rods_only;
    const auto source = load_checked_case(
        arguments_.case_folder, rods_only ? engine::CaseUse::kRods : engine::CaseUse::kOperation);
    if (!source) {
      return source.error();
    }
    case_name_ = source->name;
    auto operation = rods_only ? engine::plan_rods_alone(*source)
                               : engine::plan_operation(*source, arguments_.levels);
    if (!operation) {
      return operation.error();
    }
    OpenOptions open_options;
    open_options.phrases = engine::headset_phrases();
    open_options.room = engine::room_of(*source, *operation, engine::built_in_tools());
    open_options.room.exposure = engine::strokes_of(set_up_.method);
    if (const Status told = set_up_.tell(open_options.sim); !told) {
      return Error{"--instrument: " + told.error().message};
    }
    if (const Status opened = open_headset(open_options); !opened) {
      return opened.error();
    }
    if (rods_only) {
      if (const Status standing = look_at_case_of_rods(*source, *operation); !standing) {
        return standing.error();
      }
    }
    warn_of_sizes(*operation, sizes_);
    return start(std::move(*operation));
  }

  /// A case is only the patient's name here, unless the room is simulated: then its screws stand in
  /// it.
  Status look_at_case_of_rods(const engine::Case& source, const engine::Operation& operation) {
    if (room_) {
      return engine::check_standing_screws(operation, room_->room());
    }
    if (arguments_.case_folder.empty()) {
      case_name_ = "not stated";
      return {};
    }
    std::size_t screws = 0;
    for (const engine::CaseLevel& level : source.levels) {
      screws += level.screws.size();
    }
    if (screws > 0) {
      std::fprintf(stderr,
                   "orthonav: rods alone: the %zu planned screws of case '%s' are not guided\n",
                   screws, source.name.c_str());
    }
    return {};
  }

  /// Opens the headset with the clicker and voice joined to it.
  Status open_headset(const OpenOptions& options) {
    auto opened = open_with_room(arguments_.headset, options);
    if (!opened) {
      return opened.error();
    }
    headset_ = std::move(opened->headset);
    room_ = opened->room;
    if (arguments_.headset == "openxr:") {
      std::fprintf(stderr, "openxr: no cameras are named, so the simulated room's: openxr:+sim:\n");
    }
    onlookers_.log().say("headset " + headset_->name() + ", case " + case_name_);
    if (!opened->warning.empty()) {
      onlookers_.log().warn(opened->warning);
      print_warning(opened->warning);
    }
    const auto calibrated = arguments_.calibration.on(*headset_, opened->calibration_file);
    if (!calibrated) {
      return calibrated.error();
    }
    auto joined = join_parts(**calibrated, arguments_.clicker, arguments_.voice);
    if (!joined) {
      return joined.error();
    }
    joined_ = std::move(*joined);
    return {};
  }

  /// Checks everything possible before the models are prepared, which takes a while.
  Status check_arguments() {
    if (!is_simulated(arguments_.headset) && arguments_.set_up.tells_surgeon()) {
      return Error{"--guidance and --instrument are for the simulated surgeon (--headset sim:)"};
    }
    if (const Status good = check_headset_uri(arguments_.headset); !good) {
      return good;
    }
    if (arguments_.headset.find("pace=step") != std::string::npos) {
      return Error{"headset URI \"" + arguments_.headset +
                   "\": cannot be stepped here; known paces are fast and realtime"};
    }
    if (!arguments_.tools_file.empty()) {
      auto tools = engine::load_tools(arguments_.tools_file, engine::ToolTags::kOptional);
      if (!tools) {
        return tools.error();
      }
      tools_ = std::move(*tools);
    }
    auto sizes = arguments_.screws.sizes();
    if (!sizes) {
      return sizes.error();
    }
    sizes_ = std::move(*sizes);
    if (const Status opened = onlookers_.open(arguments_.onlookers); !opened) {
      return opened;
    }
    warn_of_space("--record", arguments_.record, recording_bytes(arguments_.for_s));
    warn_of_space("--out", arguments_.out, kResultBytes);
    return arguments_.resume ? files_.kept().find(arguments_.out) : Status{};
  }

  engine::AssemblyOptions assembly_options() {
    engine::AssemblyOptions options;
    options.use_reference = set_up_.reference;
    options.reference_places = files_.kept().reference_places();
    if (room_) {
      options.errors = engine::errors_in(room_->options());
      engine::tell_instruments(room_->options(), options.session);
      options.visibility.cross_and_depth =
          room_->options().guidance != sim::GuidanceProfile::kPublished;
    }
    arguments_.common.set_in(options.errors);
    options.session.replan.sizes = sizes_;
    options.session.head_to_seat_m = arguments_.rods.seat_mm * 1e-3;
    arguments_.limits.set_in(options);
    options.loop.max_frames = arguments_.frames;
    options.loop.max_time = from_seconds(arguments_.for_s);
    // The dashboard looks twice a second.
    constexpr int kForDashboard = 5;
    options.loop.draw_every = Presenting::is_possible(*headset_) ? 1
                              : onlookers_.draw()                ? kForDashboard
                                                                 : 0;
    options.loop.real_time = options.loop.draw_every > 0;
    return options;
  }

  Status start(engine::Operation operation) {
    const auto tools = tools_ ? Result<std::vector<nav::ToolGeometry>>(*tools_)
                              : engine::tools_known_to(*headset_);
    if (!tools) {
      return tools.error();
    }
    auto assembled = engine::assemble_operation(*joined_, std::move(operation), method_, *tools,
                                                assembly_options());
    if (!assembled) {
      return assembled.error();
    }
    operation_ = std::move(*assembled);
    if (const Status same = files_.kept().check(operation_->session(), about()); !same) {
      return same;
    }
    operation_->observe(&end_note_);
    operation_->observe(&to_wearer_.emplace(*joined_));
    if (room_) {
      operation_->observe(&ground_truth_.emplace(*room_, operation_->session()));
    }
    if (const Status kept = keep(); !kept) {
      return kept;
    }
    return arguments_.record.empty()
               ? Status{}
               : files_.record(*operation_, arguments_.record, *joined_, *tools, onlookers_.log());
  }

  Status keep() {
    if (arguments_.out.empty()) {
      return {};
    }
    if (const Status made = files_.make_folder(arguments_.out); !made) {
      return made;
    }
    if (const Status kept = files_.keep(*operation_, about()); !kept) {
      return kept;
    }
    return {};
  }

  [[nodiscard]] KeptOperation::About about() const {
    KeptOperation::About about;
    about.case_name = case_name_;
    about.method = method_.name;
    about.patient_reference = set_up_.reference;
    about.device = headset_->name();
    about.epoch_100ns = headset_->epoch_ticks_100ns();
    if (room_) {
      about.seed = room_->options().seed;
    }
    return about;
  }

  void print_figures(const engine::LoopReport& loop) {
    if (!arguments_.stats) {
      return;
    }
    print_stats(loop);
    if (const auto connection = headset_->connection()) {
      std::fputs(connection_report(*connection).c_str(), stderr);
    }
  }

  RunArguments arguments_;
  engine::SetUp set_up_;
  StopSignals& signals_;
  engine::Method method_;
  std::optional<std::vector<nav::ToolGeometry>> tools_;
  engine::ScrewSizes sizes_;  ///< of the file, where one was named
  std::string case_name_;
  std::unique_ptr<Headset> headset_;
  std::unique_ptr<JoinedHeadset> joined_;  ///< with the clicker and the voice asked for
  RunFiles files_;
  const sim::SimHeadset* room_ = nullptr;  ///< that the cameras see, if it is simulated
  std::optional<engine::GroundTruthRecorder> ground_truth_;
  engine::EndNote end_note_;
  std::optional<sim::ShownToWearer> to_wearer_;
  Onlookers onlookers_;
  std::unique_ptr<engine::AssembledOperation> operation_;
  Presenting presenting_;
};

}  // namespace

int run_live(const RunArguments& arguments, StopSignals& signals) {
  return LiveRun(arguments, signals).run();
}

}  // namespace orthonav::tools
