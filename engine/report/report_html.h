#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/report/registration_figures.h"

namespace orthonav::engine {

/// One picture of the report: the surgeon's view at one step.
struct ReportPicture {
  std::string title;    ///< "L4: verify the registration"
  std::string caption;  ///< what to look at, in one sentence
  std::vector<std::uint8_t> png;
};

/// One curve over time.
struct ReportCurve {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
};

/// One plot with its axes' names and units; `limit` draws a dashed line when it is positive.
struct ReportPlot {
  std::string title;
  std::string x_axis;  ///< "time since the tool was placed [s]"
  std::string y_axis;
  std::vector<ReportCurve> curves;
  double limit = 0.0;
};

/// Wall-clock cost of one kind of work, in milliseconds per frame.
struct ReportTiming {
  std::string name;  ///< "track a stereo pair"
  std::vector<double> ms;
};

struct ReportContent {
  std::string report_json;  ///< the text of report.json: the page shows exactly those figures
  std::string video;        ///< file name beside the page; empty: none
  std::vector<RegisteredLevel> registrations;  ///< drawn, one section each
  std::vector<ReportPicture> pictures;
  std::vector<ReportPlot> plots;
  std::vector<ReportTiming> timings;
  std::vector<std::string> notes;  ///< sentences under the table: what was simulated, limits
};

/// The report as one self-contained HTML page: the paper's table beside this run, errors of every
/// screw, plots, pictures, frame times. Fails only on a report_json that is not what `demo` writes.
Result<std::string> report_html(const ReportContent& content);

}  // namespace orthonav::engine
