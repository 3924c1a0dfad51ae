#include <cstdio>
#include <exception>

#include "tools/command.h"

namespace orthonav::tools {

int bad_input(const std::string& message) {
  std::fprintf(stderr, "orthonav: %s\n", message.c_str());
  return kBadInput;
}

namespace {

int run(int argc, char** argv) {
  CLI::App app{"orthonav: standalone mixed-reality navigation for orthopaedic surgery"};
  app.require_subcommand(1);
  app.set_version_flag("--version", ORTHONAV_VERSION);
  Action action;
  add_demo_command(app, action);
  add_detect_command(app, action);
  add_doctor_command(app, action);
  add_golden_command(app, action);
  add_register_command(app, action);
  add_rod_command(app, action);
  add_run_command(app, action);
  add_study_command(app, action);
  add_track_command(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? kDone : kBadInput;
  }
  return action ? action() : kBadInput;
}

}  // namespace
}  // namespace orthonav::tools

int main(int argc, char** argv) {
  try {
    return orthonav::tools::run(argc, argv);
  } catch (const std::exception& error) {
    return orthonav::tools::bad_input(error.what());
  }
}
