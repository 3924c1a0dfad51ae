#include "tools/orthonav/study/study_replay.h"

#include <filesystem>
#include <map>

#include "study/study_profile.h"

namespace orthonav::tools {
namespace {

namespace fs = std::filesystem;

/// A text as one word of a shell; in quotes where it needs them.
std::string quoted(const std::string& text) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+:,@%-";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) {
    return text;
  }
  std::string out = "'";
  for (const char c : text) {
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return out + "'";
}

std::string absolute_path(const std::string& path) {
  std::error_code code;
  return fs::absolute(path, code).string();
}

/// The name of a profile, or the absolute path of its file.
std::string profile_word(const std::string& name_or_file) {
  std::error_code code;
  return fs::is_regular_file(name_or_file, code) ? absolute_path(name_or_file) : name_or_file;
}

/// The words of the command line that define an operation: all except number, seeds and output. For
/// a shell, with folders as absolute paths.
std::string operation_words(const StudyArguments& arguments, const std::string& cases) {
  std::string words;
  const auto add = [&words](const char* name, const std::string& value) {
    if (!value.empty()) {
      words += std::string(" ") + name + " " + quoted(value);
    }
  };
  add("--cases", cases.empty() ? "" : absolute_path(cases));
  add("--method", arguments.method);
  add("--profile", profile_word(arguments.profile));
  add("--measurement", arguments.measurement);
  for (const std::string& level : arguments.levels) {
    add("--levels", level);
  }
  words += arguments.perfect ? " --perfect" : "";
  words += arguments.navigation_alone ? " --navigation-alone" : "";
  words += arguments.reference ? " --reference" : "";
  add("--guidance", arguments.surgeon.guidance);
  add("--instrument", arguments.surgeon.instrument);
  add("--strokes", arguments.surgeon.strokes);
  add("--tools", arguments.tools.empty() ? "" : absolute_path(arguments.tools));
  for (const std::string& step : arguments.without) {
    add("--without", step);
  }
  return words;
}

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
