#pragma once

#include <span>
#include <string>
#include <vector>

#include "study/study.h"
#include "study/study_page.h"
#include "study/study_profile.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/json_output.h"
#include "tools/orthonav/study/surgeon_arguments.h"

namespace orthonav::tools {

/// The arguments of `study`.
struct StudyArguments {
  std::string cases;
  std::string method = "best";
  std::string profile;
  std::string measurement = "pixels";
  std::string store;
  std::vector<std::string> levels;
  int runs = 20;
  bool runs_given = false;  ///< on the command line
  std::uint64_t first_seed = 1;
  std::string shard = "1/1";
  int jobs = 0;
  JsonOutput json;
  bool perfect = false;
  bool navigation_alone = false;
  bool reference = false;
  std::vector<std::string> without;  ///< steps of the method that are left out
  SurgeonArguments surgeon;
  std::string tools;   ///< file; empty: the built-in ones
  std::string report;  ///< HTML page; empty: none
  std::vector<std::string> merged;
  std::string merged_report;  ///< HTML page of the joined study; empty: none
  JsonOutput merged_json;
};

void add_options(CLI::App& study, StudyArguments& arguments);
/// A case folder, or a folder of case folders in the order of their names; the phantom without one.
Result<std::vector<engine::Case>> cases_in(const std::string& folder);
Result<engine::StudyOptions> options_of(const StudyArguments& arguments);

/// Number of simultaneous operations: as given, or the number of cores.
[[nodiscard]] int jobs_or_cores(int jobs);
/// An operation of a study: the built-in tools, no pictures.
[[nodiscard]] engine::OperationOptions study_operation();

/// Writes a study as JSON where that is asked for, as a page if `page` is not empty, and as a table
/// unless standard output carries the JSON; returns the exit code.
int write_study(const JsonOutput& json, const std::string& page, const std::string& study,
                const engine::ReplayCommand& replay = {});

}  // namespace orthonav::tools
