#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace orthonav::tools {

/// As `orthonav run` takes them.
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

/// An operation on the headset asked for, from opening it to what is left in files. Returns the
/// exit code.
int run_live(const RunArguments& arguments);

}  // namespace orthonav::tools
