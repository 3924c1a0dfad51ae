#include "engine/holograms/hologram.h"

#include "base/translation.h"
#include "engine/holograms/shapes/hologram_colours.h"
#include "engine/holograms/shapes/hologram_numbers.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/holograms/shapes/screw_holograms.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine {
namespace {

using namespace labels;

constexpr render::Label kTwin = label_of(HologramKind::kTwin, 1);
constexpr render::Label kNumbers = label_of(HologramKind::kNumbers, 1);
constexpr render::Label kClearance = label_of(HologramKind::kNumbers, 3);
constexpr render::Label kWord = label_of(HologramKind::kNumbers, 4);
constexpr CrossLabels kCrossLabels = {label_of(HologramKind::kAngle, 1),
                                      label_of(HologramKind::kNumbers, 6),
                                      label_of(HologramKind::kDepth, 1)};
constexpr render::Label kAngle = label_of(HologramKind::kAngle, 2);  // beside the triangle
constexpr render::Label kTipDistance = label_of(HologramKind::kDepth, 2);

Point<World> to_point(render::Float3 p) { return {{p.x, p.y, p.z}}; }

/// Above the cross, at most one: "stop", or "may break through medially". Mostly nothing.
void append_cross_word(std::string& out, const Visibility& visible) {
  if (visible.drill.alarm == nav::DrillAlarm::kStop) {
    append_drill(out, visible.drill);
  } else if (visible.clearance != nullptr && visible.clearance->may_break()) {
    append_breach(out, *visible.clearance);
  } else if (visible.drill.phase == nav::DrillPhase::kDrilling && !visible.drill.watched) {
    append_drill(out, visible.drill);
  }
}

/// Of the selected screw: H4 with the measured wire, H5 to H9, H13.
class SelectedScrew : public Hologram {
 public:
  explicit SelectedScrew(Surfaces& surfaces) : surfaces_(surfaces) {}

  void draw(const Guidance& /*guidance*/, const Visibility& visible,
            render::Scene& scene) override {
    if (!visible.trajectory) {
      return;
    }
    const PlacedScrew& screw = *visible.trajectory;
    const TrajectoryLine line = trajectory_of(screw);
    add_planned_trajectory(scene, to_float3(line.entry.v), to_float3(line.target.v),
                           label_of(HologramKind::kTrajectory, 1));
    if (visible.wire) {
      add_wire(scene, screw, *visible.wire, text_);
    }
    if (visible.triangle) {
      const nav::ScrewGuidance& shown = *visible.triangle;
      add_deviation_triangle(scene, to_float3(shown.a.v), to_float3(shown.b.v),
                             to_float3(shown.c.v), visible.verdict.grade,
                             label_of(HologramKind::kTriangle, 1));
    }
    if (!visible.cross) {
      add_angle(line, visible, scene);
    }
    if (visible.approach) {
      add_tip_distance(scene, to_float3(visible.approach->tip.v), visible.approach->distance_m,
                       kTipDistance);
    }
    if (visible.cross) {
      add_cross(screw, visible, scene);
    }
    if (visible.twin) {
      add_virtual_twin(screw, visible, scene);
    }
  }

  void tell(const Guidance& /*guidance*/, const Visibility& visible,
            ShownHolograms& told) override {
    if (!visible.trajectory) {
      return;
    }
    const PlacedScrew& screw = *visible.trajectory;
    const TrajectoryLine line = trajectory_of(screw);
    told.add(HologramKind::kTrajectory).points_in_world = {line.outside, line.entry, line.target};
    if (visible.wire) {
      const TrajectoryLine placed = line_of(*visible.wire, screw);
      ShownHologram& wire = told.add(HologramKind::kTrajectory);
      append_wire(wire.text, *visible.wire);
      wire.points_in_world = {placed.outside, placed.entry, placed.target};
    }
    if (visible.triangle) {
      const nav::ScrewGuidance& shown = *visible.triangle;
      told.add(HologramKind::kTriangle).points_in_world = {shown.a, shown.b, shown.c};
    }
    if (visible.approach) {
      ShownHologram& tip = told.add(HologramKind::kDepth);
      append_rounded_mm(tip.text, visible.approach->distance_m);
      tip.points_in_world.push_back(visible.approach->tip);
    }
    if (visible.twin) {
      const VirtualTwin twin = twin_of(screw);
      ShownHologram& shown = told.add(HologramKind::kTwin);
      for (const Point<World>& place : {line.entry, line.target}) {
        shown.points_in_world.push_back(to_point(in_twin(twin, to_float3(place.v))));
      }
    }
    if (!visible.cross) {
      if (visible.measurement || visible.angle_lost) {
        const auto angle_rad =
            visible.measurement ? std::optional(visible.measurement->angle_rad) : std::nullopt;
        ShownHologram& angle = told.add(HologramKind::kAngle);
        angle.text = angle_text(angle_rad);
        angle.reading = read_angle_rad(angle_rad);
      }
      return;
    }
    tell_cross(screw, visible, told);
    if (visible.sizes != nullptr || visible.angle_lost) {
      tell_sizes(visible, told);
    }
    if (visible.depth) {
      append_depth(told.add(HologramKind::kDepth).text, *visible.depth);
    }
    if (visible.numbers) {
      for (std::size_t row = 0; row < kNumberRows; ++row) {
        ShownHologram& shown = told.add(HologramKind::kNumbers);
        shown.side = screw.plan().side;
        append_number(shown.text, *visible.numbers, static_cast<NumberRow>(row));
      }
      if (visible.clearance) {
        append_clearance_line(told.add(HologramKind::kNumbers).text, *visible.clearance,
                              screw.at.level->registration_only());
      }
    }
  }

 private:
  /// H6 beside the triangle; without one, where it would be if the tool were on the plan.
  void add_angle(const TrajectoryLine& line, const Visibility& visible, render::Scene& scene) {
    if (visible.measurement) {
      const nav::ScrewGuidance& shown = *visible.triangle;
      add_angle_readout(scene, to_float3(shown.a.v), to_float3(shown.b.v),
                        angle_text(visible.measurement->angle_rad), visible.verdict.grade, kAngle);
    } else if (visible.angle_lost) {
      add_angle_readout(scene, to_float3(line.entry.v), to_float3(line.outside.v),
                        angle_text(std::nullopt), Grade::kPoor, kAngle);
    }
  }

  /// The triangle is where the tool will be at the display time; the numbers, and the verdict
  /// behind every colour, come from one stereo pair.
  void add_cross(const PlacedScrew& screw, const Visibility& visible, render::Scene& scene) {
    const TargetCross cross = cross_of(screw, visible);
    add_target_cross(scene, cross, kCross);
    if (visible.sizes != nullptr || visible.angle_lost) {
      add_cross_numbers(scene, cross, cross_numbers_of(visible), kCrossLabels);
    }
    text_.clear();
    append_cross_word(text_, visible);
    if (!text_.empty()) {
      const bool stop = visible.drill.alarm == nav::DrillAlarm::kStop;
      const bool breaks = visible.verdict.grade == Grade::kPoor || stop || !visible.drill.watched;
      add_cross_word(scene, cross, text_, breaks ? look::colours().poor : look::colours().fair,
                     stop, stop ? kStop : kWord);
    }
    if (visible.numbers) {
      add_numbers(scene, cross, *visible.numbers, screw.at.level->registration_only(), kNumbers,
                  visible.clearance && visible.clearance->lower_95_tenths);
      if (visible.clearance) {
        add_clearance(scene, cross, *visible.clearance, kClearance);
      }
    }
  }

  void add_virtual_twin(const PlacedScrew& screw, const Visibility& visible, render::Scene& scene) {
    const VirtualTwin twin = twin_of(screw);
    const TrajectoryLine line = trajectory_of(screw);
    parts_.clear();
    add_vertebra(parts_, surfaces_.of(*screw.at.level),
                 to_matrix(screw.at.world_from_vertebra.row_major()), kTwin);
    add_planned_trajectory(parts_, to_float3(line.entry.v), to_float3(line.target.v), kTwin);
    add_twin(scene, twin, parts_, kTwin);
    if (!visible.triangle) {
      return;
    }
    const nav::ScrewGuidance& shown = *visible.triangle;
    parts_.clear();
    add_deviation_triangle(parts_, to_float3(shown.a.v), to_float3(shown.b.v), to_float3(shown.c.v),
                           visible.verdict.grade, kTwinTool);
    add_tool(parts_, to_float3(shown.tip.v), to_float3(shown.tool_outward), kTwinTool);
    add_twin(scene, twin, parts_, kTwinTool);
  }

  static void tell_cross(const PlacedScrew& screw, const Visibility& visible,
                         ShownHolograms& told) {
    const TargetCross cross = cross_of(screw, visible);
    const CrossPlaces places = places_of(cross);
    ShownHologram& shown = told.add(HologramKind::kCross);
    if (cross.lost) {
      shown.text = translated(words::kToolLost);
    } else {
      append_cross_word(shown.text, visible);
    }
    shown.points_in_world.push_back(to_point(places.middle));
    if (!cross.reading) {
      return;
    }
    for (const render::Float3 dot : places.dots) {
      shown.points_in_world.push_back(to_point(dot));
    }
  }

  /// A bound is no reading of where the tool is.
  static void tell_sizes(const Visibility& visible, ShownHolograms& told) {
    ShownHologram& angle = told.add(HologramKind::kAngle);
    if (visible.sizes == nullptr) {
      angle.text = angle_text(std::nullopt);
      return;
    }
    const auto read = [](const nav::ShownSize& size, double tenth) {
      return size.certainty == nav::Certainty::kSure ? std::optional(size.tenths * tenth)
                                                     : std::nullopt;
    };
    append_angle(angle.text, visible.sizes->angle);
    angle.reading = read(visible.sizes->angle, nav::kTenth_rad);
    ShownHologram& offset = told.add(HologramKind::kNumbers);
    append_offset(offset.text, visible.sizes->offset);
    offset.reading = read(visible.sizes->offset, nav::kTenth_m);
  }

  Surfaces& surfaces_;
  std::string text_;
  render::Scene parts_;  ///< of the twin
};

}  // namespace

std::unique_ptr<Hologram> selected_screw_hologram(Surfaces& surfaces) {
  return std::make_unique<SelectedScrew>(surfaces);
}

}  // namespace orthonav::engine
