#pragma once

#include <string>
#include <vector>

#include "engine/holograms/shapes/hologram_shapes.h"
#include "engine/live/frame_loop.h"
#include "engine/report/report_html.h"

namespace orthonav::tools {

/// Records the readings shown while each screw was guided: the angle, and the distance of the tip
/// from the entry.
class ReadingCurves : public engine::LoopObserver {
 public:
  void stepped(const FrameHeader& frame, const engine::Inputs& inputs,
               const engine::Guidance& guidance) override;

  /// The plots of the report: angle and distance over the time since the tool was first seen, with
  /// the angles at which the display changes its colour.
  [[nodiscard]] std::vector<engine::ReportPlot> plots(const engine::GradeLimits& limits) const;

 private:
  struct Screw {
    engine::StepOnDisplay at;
    Timestamp begin{};
    std::vector<double> time_s;
    std::vector<double> angle_deg;
    std::vector<double> distance_mm;
  };
  std::vector<Screw> screws_;
};

}  // namespace orthonav::tools
