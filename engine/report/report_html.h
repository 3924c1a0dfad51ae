#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/histogram.h"
#include "base/result.h"
#include "engine/report/registration_figures.h"
#include "engine/report/spine_view.h"

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

/// A dashed line across a plot.
struct ReportLine {
  double y = 0.0;
  std::string name;  ///< "poor above 5°"
};

/// One plot with its axes' names and units.
struct ReportPlot {
  std::string title;
  std::string x_axis;  ///< "time since the tool was placed [s]"
  std::string y_axis;
  std::vector<ReportCurve> curves;
  std::vector<ReportLine> lines = {};
  /// If positive, the axis ends here: values above are drawn at its edge and marked, so that a tool
  /// moving through the room does not flatten the relevant part.
  double y_max = 0.0;
};

/// Wall-clock cost of one kind of work, in milliseconds per frame.
struct ReportTiming {
  std::string name;  ///< "track a stereo pair"
  Histogram ms;
};

struct ReportContent {
  std::string report_json;  ///< the text of report.json; the page shows exactly its figures
  /// When the operation began, for people: "2026-11-25 10:04 UTC"; empty: not known. Provided by
  /// the command, since a report reads no clock.
  std::string date;
  std::string video;                 ///< file name beside the page; empty: none
  std::vector<std::uint8_t> poster;  ///< a PNG to show while the film is not played; empty: none
  std::vector<RegisteredLevel> registrations;  ///< drawn, one section each
  SpineView spine;                             ///< the vertebrae with their screws, to be turned
  std::string spine_note;                      ///< a sentence on what lies where in it
  std::vector<ReportPicture> pictures;
  std::vector<ReportPlot> plots;
  std::vector<ReportTiming> timings;
  std::string beside_json;  ///< report.json of another run to be set beside this one; empty: none
  std::string beside_page;  ///< its page, from this one
  std::vector<std::string> notes;  ///< sentences under the table: simulated parts, limits
};

/// The report as one self-contained HTML page, in the order in which a surgeon needs it: verdict,
/// film, spine and a line a screw; the rest is folded: clearance, registrations, rods, pictures,
/// the paper's table beside this run, plots, frame times. The same content gives the same bytes.
/// Fails only if report_json is not in the format that `demo` writes.
Result<std::string> report_html(const ReportContent& content);

}  // namespace orthonav::engine
