#include "tools/study_replay.h"

#include <map>

namespace orthonav::tools {
namespace {

std::string preview_words(const StudyArguments& arguments, const std::string& folder) {
  std::string words = " --method " + quoted(arguments.method);
  words += folder.empty() ? "" : " --case " + quoted(folder);
  for (const std::string& level : arguments.levels) {
    words += " --levels " + quoted(level);
  }
  return words + (arguments.perfect ? " --perfect" : "");
}

}  // namespace

engine::ReplayCommand replay_of(const StudyArguments& arguments,
                                std::span<const engine::Case> cases) {
  std::map<std::string, std::string> folders;
  for (const engine::Case& one : cases) {
    folders.emplace(one.name, one.folder);
  }
  const bool shown = arguments.profile.empty() && arguments.measurement == "pixels" &&
                     !arguments.navigation_alone && arguments.without.empty() &&
                     arguments.guidance.empty() && arguments.instrument.empty() &&
                     arguments.tools.empty();
  return [arguments, folders, shown](const std::string& case_name, std::uint64_t seed) {
    const auto known = folders.find(case_name);
    const std::string folder = known == folders.end() ? "" : known->second;
    const std::string number = " --seed " + std::to_string(seed);
    return shown ? "orthonav preview" + number + preview_words(arguments, folder)
                 : "orthonav study" + operation_words(arguments, folder) + " --runs 1" + number;
  };
}

}  // namespace orthonav::tools
