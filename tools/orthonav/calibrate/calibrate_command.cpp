#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/orthonav/calibrate/calibrate.h"

namespace orthonav::tools {

void add_judgement(const nav::Judgement& judgement, nlohmann::ordered_json& out) {
  out["verdict"] = nav::to_text(judgement.verdict);
  out["reason"] = judgement.reason;
}

void print_judgement(const nav::Judgement& judgement) {
  std::printf("%s: %s\n", std::string(nav::to_text(judgement.verdict)).c_str(),
              judgement.reason.c_str());
}

int refused(const std::string& reason) {
  std::fprintf(stderr, "orthonav: refused: %s\n", reason.c_str());
  return kNo;
}

void add_calibrate_command(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("calibrate", "The tip, axis and tags of a tool, the stereo cameras");
  command->require_subcommand(1);
  add_calibrate_pivot(*command, action);
  add_calibrate_axis(*command, action);
  add_calibrate_stereo(*command, action);
  add_calibrate_tool(*command, action);
  command->footer(
      "\nExit code 0: the verdict is pass or note; 1: fail, with the reason on standard error;\n"
      "2: bad input.");
}

}  // namespace orthonav::tools
