#include "tools/orthonav/study/study_replay.h"

#include <map>

#include "study/study_profile.h"

namespace orthonav::tools {
namespace {

/// Whether the preview can show an operation of the study: it must consist only of the room, the
/// guidance and the method of its profile, measured on pixels.
bool can_be_shown(const StudyArguments& arguments) {
  if (arguments.navigation_alone || arguments.reference || !arguments.without.empty() ||
      arguments.surgeon.is_given() || !arguments.tools.empty()) {
    return false;
  }
  const auto profile = arguments.profile.empty()
                           ? Result<engine::StudyProfile>(engine::StudyProfile())
                           : engine::profile_named(arguments.profile);
  return profile.ok() && profile->can_be_previewed();
}

std::string preview_of(const StudyArguments& arguments, const std::string& folder,
                       std::uint64_t seed) {
  std::string words = "orthonav preview --replay " + std::to_string(seed);
  words += arguments.profile.empty() ? " --method " + quoted(arguments.method)
                                     : " --profile " + quoted(profile_word(arguments.profile));
  words += folder.empty() ? "" : " --case " + quoted(absolute_path(folder));
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
  const bool shown = can_be_shown(arguments);
  const bool pixels = arguments.measurement == "pixels";
  return [arguments, folders, shown, pixels](const std::string& case_name, std::uint64_t seed) {
    const auto known = folders.find(case_name);
    const std::string folder = known == folders.end() ? "" : known->second;
    const std::string look = preview_of(arguments, folder, seed);
    if (shown && pixels) {
      return look;
    }
    const std::string again = "orthonav study" + operation_words(arguments, folder) +
                              " --runs 1 --seed " + std::to_string(seed);
    return shown ? again + "  # the same bones and hands on pixels: " + look : again;
  };
}

}  // namespace orthonav::tools
