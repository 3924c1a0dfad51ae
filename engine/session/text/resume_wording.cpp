#include "engine/session/text/resume_wording.h"

#include <string_view>

#include "base/how_many.h"
#include "base/joined.h"

namespace orthonav::engine {
namespace {

constexpr std::string_view kSides[] = {"left", "right"};

std::string listed(const std::vector<std::string>& parts) { return joined(parts, ", "); }

std::string what_it_was(const OperationLog::Found& found) {
  const OperationIdentity& identity = found.operation.identity;
  std::string line = "resuming " + found.path + ": case '" + identity.case_name + "', " +
                     levels_text(identity) + ", begun " + identity.begun + ", " +
                     how_many(found.operation.records, "record");
  if (found.operation.resumed > 0) {
    line += ", resumed before";
  }
  return line;
}

std::vector<std::string> placed(const OperationState& operation) {
  std::vector<std::string> screws;
  for (const LevelState& level : operation.levels) {
    for (std::size_t i = 0; i < level.screws.size(); ++i) {
      if (level.screws[i].done) {
        screws.push_back(level.plan.label + " " + name_of(level.plan.screws[i].side));
      }
    }
  }
  return screws;
}

/// What is kept of an open level, and how it is verified.
std::string to_verify(const LevelState& level) {
  if (level.finished() || !level.registration) {
    return {};
  }
  const bool landmark = level.accepted && level.landmark;
  return level.plan.label + (landmark
                                 ? ": accepted before, not verified: touch its landmark"
                                 : ": registered before, not verified: touch its check points");
}

/// What is lost of an open level.
std::vector<std::string> lost(const LevelState& before, const LevelState& after,
                              std::size_t regions) {
  std::vector<std::string> parts;
  if (before.finished()) {
    return parts;
  }
  if (regions > 0) {
    parts.push_back(how_many(regions, "region"));
  }
  if (before.registration && !after.registration) {
    parts.emplace_back(before.accepted ? "its accepted registration" : "its registration");
  }
  if (before.landmark && !after.landmark) {
    parts.emplace_back("its landmark");
  }
  if (!before.check_points.empty()) {
    parts.push_back(how_many(before.check_points.size(), "check point"));
  }
  return parts;
}

std::vector<std::string> lost(const OperationLog::Found& found, const LoggedOperation& after) {
  const OperationState& before = found.operation.state;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < before.levels.size(); ++i) {
    const std::size_t regions = found.operation.strokes[i].size() - after.strokes[i].size();
    if (const auto parts = lost(before.levels[i], after.state.levels[i], regions); !parts.empty()) {
      lines.push_back("lost: of " + before.levels[i].plan.label + " " + listed(parts));
    }
  }
  for (std::size_t i = 0; i < before.rods.size(); ++i) {
    const std::size_t heads = before.rods[i].heads.size();
    if (heads > after.state.rods[i].heads.size()) {
      lines.push_back("lost: of the " + std::string(kSides[i]) + " rod " + how_many(heads, "head"));
    }
  }
  if (found.operation.guide_corrected) {
    lines.emplace_back("lost: the correction of the guide, compare it at the landmark again");
  }
  if (found.operation.dropped_bytes > 0) {
    lines.push_back("lost: " + how_many(found.operation.dropped_bytes, "byte") +
                    " behind the last whole record, kept in " + found.path + ".dropped");
  }
  return lines;
}

}  // namespace

std::vector<std::string> resume_lines(const OperationLog::Found& found) {
  LoggedOperation after = found.operation;
  after.reopen();
  std::vector<std::string> lines = {what_it_was(found)};
  const std::vector<std::string> screws = placed(found.operation.state);
  if (!after.state.levels.empty()) {
    lines.push_back("placed: " + (screws.empty() ? "no screw" : listed(screws)));
  }
  for (std::size_t i = 0; i < after.state.rods.size(); ++i) {
    const RodState& rod = after.state.rods[i];
    if (rod.done && !rod.heads.empty()) {
      lines.push_back("done: the " + std::string(kSides[i]) + " rod, " +
                      how_many(rod.heads.size(), "head"));
    }
  }
  for (const LevelState& level : after.state.levels) {
    if (std::string line = to_verify(level); !line.empty()) {
      lines.push_back(std::move(line));
    }
  }
  for (std::string& line : lost(found, after)) {
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace orthonav::engine
