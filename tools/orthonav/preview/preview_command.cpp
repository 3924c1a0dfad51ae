#include <filesystem>
#include <memory>
#include <optional>

#include "engine/case/operation_plan.h"
#include "study/study_profile.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/config/config_file.h"
#include "tools/orthonav/igtl/igtl_stream.h"
#include "tools/orthonav/operation/stopped_run.h"
#include "tools/orthonav/operation/wearer_arguments.h"
#include "tools/orthonav/preview/kept_previews.h"
#include "tools/orthonav/preview/plan_window.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/memory_reserve.h"
#include "tools/orthonav/shared/screw_arguments.h"
#include "tools/orthonav/shared/set_up_arguments.h"
#include "tools/preview/preview_app.h"

namespace orthonav::tools {
namespace {

struct PreviewArguments {
  std::string headset = "sim:";
  std::string case_folder;
  std::vector<std::string> levels;
  std::string tools_file;
  SetUpArguments set_up;
  ScrewArguments screws;
  std::string script;
  std::string profile;
  bool perfect = false;
  std::optional<double> pace;
  IgtlArguments igtl;
  KeepArguments keep;
  WearerArguments wearer;
  preview::PreviewOptions options;
  PlanWindowArguments plan;
};

/// Sets the room as asked for, or as in a profile. Refuses a profile that consists of more.
Result<engine::SetUp> set_up_of(PreviewArguments& arguments) {
  engine::SetUp set_up = chosen_for(arguments.set_up, arguments.headset);
  if (arguments.profile.empty()) {
    if (const Status told = set_up.tell(arguments.options.room); !told) {
      return Error{"--instrument: " + told.error().message};
    }
    return set_up;
  }
  const auto profile = engine::profile_named(arguments.profile);
  if (!profile) {
    return profile.error();
  }
  if (!profile->can_be_previewed()) {
    return Error{
        "--profile " + arguments.profile +
        ": the preview can't show it: it states its navigation, uses the reference, leaves "
        "steps out or exposes more"};
  }
  set_up.method = profile->method;
  set_up.reference = false;
  arguments.options.room.guidance = profile->guidance;
  arguments.options.room.error_model = profile->magnitudes;
  return set_up;
}

/// The operation to be previewed, still without the prepared models.
Result<preview::OperationSource> source_of(const PreviewArguments& arguments,
                                           const engine::SetUp& set_up) {
  preview::OperationSource source;
  source.headset = arguments.headset;
  source.tools_file = arguments.tools_file;
  source.use_reference = set_up.reference;
  auto method = engine::method_named(set_up.method);
  if (!method) {
    return method.error();
  }
  source.method = std::move(*method);
  auto sizes = arguments.screws.sizes();
  if (!sizes) {
    return sizes.error();
  }
  source.screw_sizes = std::move(*sizes);
  auto loaded = load_checked_case(arguments.case_folder);
  if (!loaded) {
    return loaded.error();
  }
  source.source = std::move(*loaded);
  const auto levels = engine::levels_to_operate(source.source, arguments.levels);
  if (!levels) {
    return Error{"--levels: " + levels.error().message};
  }
  return source;
}

/// Runs the window until it is closed or a signal ends it.
int run_until_closed(preview::PreviewApp& app, const std::string& out, StopSignals& signals) {
  signals.on_stop([&app] { app.quit(); });
  const Status done = app.run();
  signals.on_stop(nullptr);
  if (signals.caught()) {
    std::error_code ignored;
    const bool wrote = std::filesystem::exists(out, ignored);
    tell_what_is_kept(signals, {wrote ? out : std::string()});
    return signals.exit_code();
  }
  return done ? kDone : bad_input(done.error().message);
}

/// Prepares the models, which takes a while, and begins.
Status open_operation(preview::PreviewApp& app, const PreviewArguments& arguments,
                      preview::OperationSource source) {
  auto operation = engine::plan_operation(source.source, arguments.levels);
  if (!operation) {
    return operation.error();
  }
  source.operation = std::move(*operation);
  warn_of_sizes(source.operation, source.screw_sizes);
  return app.open_operation(std::move(source));
}

Result<std::optional<preview::Script>> script_of(const PreviewArguments& arguments) {
  if (arguments.script.empty()) {
    return std::optional<preview::Script>();
  }
  auto parsed = preview::Script::load(arguments.script);
  if (!parsed) {
    return parsed.error();
  }
  return std::optional(std::move(*parsed));
}

void set_room(PreviewArguments& arguments) {
  sim::ErrorModel& errors = arguments.options.room.error_model;
  if (arguments.perfect) {
    errors = sim::ErrorModel::perfect();
  }
  if (arguments.pace) {
    errors.pace = *arguments.pace;
  }
}

int plan_window(const PreviewArguments& arguments, StopSignals& signals) {
  PlanWindowArguments plan = arguments.plan;
  auto sizes = arguments.screws.sizes();
  if (!sizes) {
    return bad_input(sizes.error().message);
  }
  plan.sizes = std::move(*sizes);
  plan.case_folder = arguments.case_folder;
  plan.levels = arguments.levels;
  plan.script = arguments.script;
  plan.options.width_px = arguments.options.stage.width_px;
  plan.options.height_px = arguments.options.stage.height_px;
  plan.options.device = arguments.options.stage.device;
  plan.options.out = arguments.options.out;
  return edit_plan(std::move(plan), signals);
}

int preview_window(PreviewArguments arguments, StopSignals& signals) {
  const auto set_up = set_up_of(arguments);
  if (!set_up) {
    return bad_input(set_up.error().message);
  }
  auto source = source_of(arguments, *set_up);
  if (!source) {
    return bad_input(source.error().message);
  }
  auto script = script_of(arguments);
  if (!script) {
    return bad_input(script.error().message);
  }
  set_room(arguments);

  EventLog nowhere;
  IgtlStream igtl(nowhere);
  if (const Status opened = igtl.open(arguments.igtl); !opened) {
    return bad_input(opened.error().message);
  }
  KeptPreviews kept;
  if (const Status opened = kept.open(arguments.keep); !opened) {
    return bad_input(opened.error().message);
  }
  source->assembled = [&igtl, &kept, name = source->source.name, set_up = *set_up](
                          engine::AssembledOperation& operation, const sim::SimHeadset* room) {
    igtl.watch(operation);
    return kept.begin(operation, name, set_up, room);
  };
  source->reference_places = [&kept] { return kept.reference_places(); };
  source->ended = [&kept](const engine::LoopReport& report) { kept.ended(report); };
  preview::PreviewApp app(arguments.options, std::move(*script));
  if (const Status opened = app.open_window(); !opened) {
    return bad_input(opened.error().message);
  }
  if (const Status opened = open_operation(app, arguments, std::move(*source)); !opened) {
    return bad_input(opened.error().message);
  }
  const int code = run_until_closed(app, arguments.options.out, signals);
  igtl.tell();
  return code;
}

void add_window_options(CLI::App& preview, const std::shared_ptr<PreviewArguments>& arguments) {
  preview
      .add_option_function<std::string>(
          "--size",
          [arguments](const std::string& text) {
            const auto size = size_from(text).value_or(std::array<int, 2>{});
            arguments->options.stage.width_px = size[0];
            arguments->options.stage.height_px = size[1];
          },
          "of the picture in pixels (default: 1120x720)")
      ->check(picture_size());
  preview.add_option("-o,--out", arguments->options.out, "folder for screenshots and videos")
      ->check(some_text())
      ->capture_default_str();
  preview
      .add_option("--speed", arguments->options.speed,
                  "seconds of the operation in a second; 0: as fast as it goes")
      ->check(finite_number(0.0, 100.0))
      ->capture_default_str();
  preview.add_flag("--paused", arguments->options.paused, "wait after the first pair");
  preview.add_option("--script", arguments->script, "do what this file says, then quit")
      ->check(some_text());
  preview.add_option("--device", arguments->options.stage.device,
                     "part of the name of the Vulkan device");
}

/// Options of the room and of the simulated surgeon.
void add_room_options(CLI::App& preview, PreviewArguments& arguments) {
  auto* seed =
      preview.add_option("-s,--seed", arguments.options.room.seed, "seed of every random number");
  seed->check(seed_number())->capture_default_str();
  preview
      .add_option("--replay", arguments.options.room.seed,
                  "the operation of a study that had this seed")
      ->check(seed_number())
      ->excludes(seed);
  preview
      .add_option("--profile", arguments.profile,
                  "the setting of a study: liebmann-2019 is the publication's")
      ->check(some_text())
      ->type_name("liebmann-2019|FILE");
  preview.add_flag("--perfect", arguments.perfect, "every source of error at zero");
  preview
      .add_option("--pace", arguments.pace, "how many times as fast the surgeon works (default: 1)")
      ->check(finite_number(0.5, 4));
}

}  // namespace

void add_preview_command(CLI::App& app, Action& action, StopSignals& signals) {
  auto arguments = std::make_shared<PreviewArguments>();
  auto* preview = app.add_subcommand(
      "preview",
      "A window with the holograms over the simulated room or a recording, or with a plan");
  preview->add_option("--headset", arguments->headset, "URI: sim:, replay:PATH, igtl://HOST")
      ->check(some_text())
      ->capture_default_str();
  add_case_option(*preview, arguments->case_folder);
  add_room_options(*preview, *arguments);
  arguments->set_up.add_to(*preview);
  add_levels_option(*preview, arguments->levels);
  add_tools_option(*preview, arguments->tools_file);
  arguments->screws.add_to(*preview);
  arguments->igtl.add_to(*preview);
  arguments->keep.add_to(*preview);
  arguments->wearer.add_to(*preview);
  add_window_options(*preview, arguments);
  arguments->plan.add_to(*preview);
  add_config_option(*preview);
  preview->callback([arguments, &action, &signals] {
    action = [arguments, &signals] {
      signals.outlast_terminal();
      limit_memory();
      if (const Status spoken = arguments->wearer.use(); !spoken) {
        return bad_input(spoken.error().message);
      }
      return arguments->plan.plan ? plan_window(*arguments, signals)
                                  : preview_window(*arguments, signals);
    };
  });
}

}  // namespace orthonav::tools
