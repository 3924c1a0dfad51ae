#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/golden/golden_scenes.h"
#include "engine/holograms/shapes/hologram_cross.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "engine/holograms/shapes/hologram_status.h"
#include "nav/guidance/screw.h"
#include "nav/guidance/screw_numbers.h"

namespace orthonav::engine::golden {

// One patient for all golden pictures, prone: posterior is up. Metres.
inline constexpr render::Float3 kEntry = {0.0165f, 0.0320f, 0.0070f};
inline constexpr render::Float3 kTarget = {0.0080f, -0.0110f, 0.0040f};
inline constexpr render::Float3 kOtherEntry = {-0.0165f, 0.0320f, 0.0070f};
inline constexpr render::Float3 kOtherTarget = {-0.0080f, -0.0110f, 0.0040f};
/// Between the entry points: what the cross hangs beside.
inline constexpr render::Float3 kSite = {0, 0.0320f, 0.0070f};
inline constexpr render::Float3 kNormal = {-0.14f, 0.78f, -0.61f};
inline constexpr render::Float3 kOtherNormal = {0.14f, 0.78f, -0.61f};

// The labels of the holograms in the scenes.
inline constexpr render::Label kPathLabel = label_of(HologramKind::kPath, 1);
inline constexpr render::Label kOtherPathLabel = label_of(HologramKind::kPath, 2);
inline constexpr render::Label kVertebraLabel = label_of(HologramKind::kVertebra, 1);
inline constexpr render::Label kEntryLabel = label_of(HologramKind::kEntry, 1);
inline constexpr render::Label kOtherEntryLabel = label_of(HologramKind::kEntry, 2);
inline constexpr render::Label kTrajectoryLabel = label_of(HologramKind::kTrajectory, 1);
inline constexpr render::Label kPlacedWireLabel = label_of(HologramKind::kTrajectory, 2);
inline constexpr render::Label kTriangleLabel = label_of(HologramKind::kTriangle, 1);
inline constexpr render::Label kAngleLabel = label_of(HologramKind::kAngle, 1);
inline constexpr render::Label kCrossLabel = label_of(HologramKind::kCross, 1);
inline constexpr render::Label kCrossDotLabel = label_of(HologramKind::kCross, 2);
inline constexpr render::Label kTwinLabel = label_of(HologramKind::kTwin, 1);
inline constexpr render::Label kTwinToolLabel = label_of(HologramKind::kTwin, 2);
inline constexpr render::Label kDepthLabel = label_of(HologramKind::kDepth, 1);
inline constexpr render::Label kRodLabel = label_of(HologramKind::kRod, 1);
inline constexpr render::Label kStatusLabel = label_of(HologramKind::kStatus, 1);
inline constexpr render::Label kNumbersLabel = label_of(HologramKind::kNumbers, 1);
inline constexpr render::Label kClearanceLabel = label_of(HologramKind::kNumbers, 3);
inline constexpr render::Label kWordLabel = label_of(HologramKind::kNumbers, 4);
inline constexpr render::Label kStopLabel = label_of(HologramKind::kNumbers, 5);
inline constexpr render::Label kOffsetLabel = label_of(HologramKind::kNumbers, 6);
inline constexpr render::Label kNextActLabel = label_of(HologramKind::kNumbers, 2);
inline constexpr render::Label kTipDistanceLabel = label_of(HologramKind::kDepth, 2);
inline constexpr render::Label kCheckPointLabel = label_of(HologramKind::kCheckPoint, 1);

/// Spread over the bone, to be touched for verification.
inline constexpr std::array<render::Float3, 3> kPlacesToCheck = {
    {{0.0002f, 0.0576f, -0.0145f}, {0.0200f, 0.0352f, 0.0106f}, {-0.0200f, 0.0354f, 0.0109f}}};

/// Unit, along the plan out of the bone.
[[nodiscard]] render::Float3 planned_direction();
/// The point C of the deviation triangle.
[[nodiscard]] render::Float3 planned_point();
/// The point B of a tool that is off by the angle, towards the patient's left and head, with its
/// tip in the entry.
[[nodiscard]] render::Float3 tool_point(double angle_deg);
/// The screw of a side; the vertebra's frame is the world.
[[nodiscard]] nav::ScrewPlan plan_of(Side side);
/// The guidance for a tool that is off by the angle, with its tip beside the planned axis to the
/// same side and at this depth (< 0: before the entry).
[[nodiscard]] nav::ScrewGuidance guided(double angle_deg, double beside_m, double depth_m);

/// The numbers of a tool at the plan of a side, if the errors of its pose have these SDs along and
/// about each axis.
struct NumberSds {
  double translation_m = 0.0003;
  double rotation_rad = 0.005;
};
[[nodiscard]] nav::ScrewNumbers numbers_of(const nav::ScrewGuidance& tool, const NumberSds& sds,
                                           Side side = Side::kLeft);
/// How the product would show the sizes of its angle and offset.
[[nodiscard]] nav::ScrewSizes sizes_of(const nav::ScrewGuidance& tool, const NumberSds& sds);
/// How the product would show a depth past the entry of which so much is left to the target.
[[nodiscard]] nav::ShownDepth shown_depth(double depth_m, double to_target_m, double sd_m = 0.0004);

/// What the scenes with a tool say of the bone around the screw.
inline constexpr nav::ShownClearance kClearance{24, 11, "medial"};

/// A stroke over the lamina of a side, as a surgeon makes it.
[[nodiscard]] std::vector<render::Float3> stroke(Side side = Side::kRight);

/// Near enough to judge one hologram: 14° wide.
[[nodiscard]] std::vector<render::View> close_view(render::Float3 target);
/// The surgeon's views, both eyes, a HoloLens 2's 43°, from this distance, with the head rolled to
/// the right.
[[nodiscard]] std::vector<render::View> surgeon_views(float distance_m = 0.4263f,
                                                      float roll_deg = 0.0f);
/// The point between those eyes.
[[nodiscard]] Viewer surgeon(float distance_m = 0.4263f, float roll_deg = 0.0f);

[[nodiscard]] GoldenScene start(std::string name, std::string what,
                                std::vector<render::View> views);
/// A scene with the size of a surgeon's view.
[[nodiscard]] GoldenScene start_wide(std::string name, std::string what,
                                     std::vector<render::View> views);

// Appended in the order in which they are listed.
void add_shape_scenes(std::vector<GoldenScene>& scenes);      ///< H1 to H5
void add_precision_scenes(std::vector<GoldenScene>& scenes);  ///< H7 and H8
void add_number_scenes(std::vector<GoldenScene>& scenes);     ///< H6, H9 and H13, about the cross
void add_other_scenes(std::vector<GoldenScene>& scenes);      ///< H10 to H12
void add_step_scenes(std::vector<GoldenScene>& scenes);       ///< the workflow, step by step
void add_placed_scenes(std::vector<GoldenScene>& scenes);     ///< a wire beside its plan
void add_view_scenes(std::vector<GoldenScene>& scenes);       ///< distances, head rolls, a gaze
void add_label_scenes(std::vector<GoldenScene>& scenes);      ///< labels that make way
void add_text_scenes(std::vector<GoldenScene>& scenes);       ///< every text on every ground

}  // namespace orthonav::engine::golden
