#include <fcntl.h>
#include <unistd.h>

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
#include "base/last_words.h"
#include "tools/orthonav/bad_command_line.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/help_text.h"
#include "tools/orthonav/shared/memory_reserve.h"
#include "tools/orthonav/shared/stop_signals.h"

namespace orthonav::tools {

namespace {

/// A message as the one line that is printed.
std::string one_line(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  return "orthonav: " + message + "\n";
}

}  // namespace

int bad_input(const std::string& message) {
  std::fputs(one_line(message).c_str(), stderr);
  return kBadInput;
}

namespace {

/// A full disk under standard output is noticed only when it is flushed.
int with_output_written(int code) {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) {
    return code;
  }
  const std::string why = errno != 0 ? std::generic_category().message(errno) : "write error";
  return bad_input(std::string("standard output: cannot be written: ") + why);
}

void add_commands(CLI::App& app, Action& action, StopSignals& signals) {
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
  add_plan_command(app, action, signals);
  add_preview_command(app, action, signals);
  add_print_command(app, action);
  add_recording_command(app, action);
  add_register_command(app, action);
  add_render_command(app, action);
  add_report_command(app, action);
  add_rod_command(app, action);
  add_run_command(app, action, signals);
  add_sample_command(app, action);
  add_serve_hl2ss_command(app, action, signals);
  add_study_command(app, action, signals);
  add_track_command(app, action);
}

/// A standard stream that was closed (`2>&-`) would give its number to the next file opened, and
/// what is printed would go into that file: a log. Standard output stays one that fails.
void reserve_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0) {
      (void)::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

int run(int argc, char** argv) {
  reserve_standard_streams();
  StopSignals signals;  // before any thread
  keep_memory_reserve();
  CLI::App app{
      "orthonav: standalone mixed-reality navigation for orthopaedic surgery. Tried in simulation "
      "and on stand-ins, never yet on a headset or a patient.",
      "orthonav"};
  app.require_subcommand(1);
  app.set_version_flag("--version", ORTHONAV_VERSION);
  Action action;
  add_commands(app, action, signals);
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

/// Called when an exception leaves an unguarded thread. The log is on the disk by then.
void end_in_one_line() {
  last_words(one_line(orthonav::ended_by_exception("a thread").message));
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
  } catch (const std::system_error& error) {
    // Thrown when there is no memory for a thread's stack.
    return orthonav::tools::bad_input(error.code() == std::errc::resource_unavailable_try_again
                                          ? "out of memory, or of threads: one could not be started"
                                          : error.what());
  } catch (const std::exception& error) {
    return orthonav::tools::bad_input(error.what());
  }
}
