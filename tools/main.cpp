#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "base/guarded.h"
#include "tools/command.h"
#include "tools/did_you_mean.h"
#include "tools/help_text.h"
#include "tools/memory_reserve.h"
#include "tools/stop_signals.h"

namespace orthonav::tools {

int bad_input(const std::string& message) {
  std::string line = message;
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::fprintf(stderr, "orthonav: %s\n", line.c_str());
  return kBadInput;
}

namespace {

/// The command that was asked for, as far as it is known, and the words that lead to it.
struct Asked {
  const CLI::App* command;
  std::string way;
};

Asked asked_of(const CLI::App& app) {
  Asked asked{&app, app.get_name()};
  while (!asked.command->get_subcommands().empty()) {
    asked.command = asked.command->get_subcommands().front();
    asked.way += " " + asked.command->get_name();
  }
  return asked;
}

/// What may stand after these words: commands, or options where the word is to be one.
std::vector<std::string> possible(const CLI::App& command, bool option) {
  std::vector<std::string> names;
  if (!option) {
    for (const CLI::App* below : command.get_subcommands({})) {
      names.push_back(below->get_name());
    }
    return names;
  }
  for (const CLI::Option* known : command.get_options()) {
    for (const std::string& name : known->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  return names;
}

/// Names the word that nobody expected, and what was probably meant.
std::string about_word(const std::string& word, const Asked& asked) {
  const bool option = word.size() > 1 && word.front() == '-';
  const bool command = !option && !asked.command->get_subcommands({}).empty();
  const std::string meant = closest(word, possible(*asked.command, option));
  return (option    ? "unknown option: "
          : command ? "unknown command: "
                    : "one word too many: ") +
         word + (meant.empty() ? "" : "; did you mean " + meant + "?");
}

/// Says in one line what is wrong with the command line.
int bad_command_line(const CLI::App& app, const CLI::ParseError& error) {
  const Asked asked = asked_of(app);
  std::string message = error.what();
  // Without a known command the library reports a missing one; what was written instead says more.
  const std::vector<std::string> unknown = app.remaining(true);
  const auto option = std::find_if(unknown.begin(), unknown.end(), [](const std::string& word) {
    return !word.empty() && word.front() == '-';
  });
  const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  if (!unknown.empty() && (extra || asked.command->get_require_subcommand_min() > 0)) {
    message = about_word(extra && option != unknown.end() ? *option : unknown.front(), asked);
  }
  return bad_input(message + " (see " + asked.way + " --help)");
}

/// A full disk behind standard output shows only when it is flushed.
int with_output_written(int code) {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) {
    return code;
  }
  const std::string why = errno != 0 ? std::generic_category().message(errno) : "write error";
  return bad_input(std::string("standard output: cannot be written: ") + why);
}

int run(int argc, char** argv) {
  StopSignals signals;  // before any thread
  keep_memory_reserve();
  CLI::App app{"orthonav: standalone mixed-reality navigation for orthopaedic surgery", "orthonav"};
  app.require_subcommand(1);
  app.set_version_flag("--version", ORTHONAV_VERSION);
  Action action;
  add_calibrate_command(app, action);
  add_accuracy_command(app, action);
  add_case_command(app, action);
  add_completion_command(app, action);
  add_config_command(app, action);
  add_demo_command(app, action, signals);
  add_depth_command(app, action);
  add_detect_command(app, action);
  add_doctor_command(app, action);
  add_evaluate_command(app, action);
  add_golden_command(app, action);
  add_manual_command(app, action);
  add_plan_command(app, action);
  add_preview_command(app, action, signals);
  add_print_command(app, action);
  add_recording_command(app, action);
  add_register_command(app, action);
  add_render_command(app, action);
  add_report_command(app, action);
  add_rod_command(app, action);
  add_run_command(app, action, signals);
  add_serve_hl2ss_command(app, action, signals);
  add_study_command(app, action, signals);
  add_track_command(app, action);
  use_help_text(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      return bad_command_line(app, error);
    }
    return with_output_written(app.exit(error) == 0 ? kDone : kBadInput);
  }
  return with_output_written(action ? action() : kBadInput);
}

/// An exception left a thread that nobody guards. Whatever was to be kept is on the disk by then.
void end_in_one_line() {
  bad_input(orthonav::ended_by_exception("a thread").message);
  std::_Exit(kBadInput);
}

}  // namespace
}  // namespace orthonav::tools

int main(int argc, char** argv) {
  std::set_terminate(orthonav::tools::end_in_one_line);
  try {
    return orthonav::tools::run(argc, argv);
  } catch (const std::bad_alloc&) {
    return orthonav::tools::bad_input("out of memory");
  } catch (const std::exception& error) {
    return orthonav::tools::bad_input(error.what());
  }
}
