#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/report/operation_result.h"
#include "engine/report/report_html.h"
#include "tools/orthonav/operation/step_pictures.h"

namespace orthonav::tools {

struct DemoReport {
  std::string date;  ///< when the operation began, for people
  bool simulated = true;
  bool perfect = false;     ///< every source of error was at zero, in the simulated room
  std::string surgeon;      ///< how the simulated surgeon places screws, a sentence
  bool video = false;       ///< there is an operation.mp4 next to the page
  std::string beside_json;  ///< of another run, for its figures beside this one's; empty: none
  std::string beside_page;
  std::vector<engine::ReportPlot> plots;
  std::vector<StepPicture> pictures;
};

/// Writes report.html into `folder`.
Status write_demo_report(const std::filesystem::path& folder, const engine::OperationResult& result,
                         const DemoReport& report);

}  // namespace orthonav::tools
