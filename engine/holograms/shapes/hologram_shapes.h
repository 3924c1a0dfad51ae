#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/holograms/shapes/hologram_colours.h"
#include "render/scene.h"

namespace orthonav::engine {

// The appearance of each hologram, as pure functions from plain world values (metres) to items of a
// render::Scene. What is shown when is decided by the scene builder. Labels follow the scene's
// convention, 100·n + k for the k-th instance of hologram Hn.

/// How far the tool is from the plan, as shown by colours.
enum class Grade { kGood, kFair, kPoor };
/// What is worst about it; in the order of urgency.
enum class Worst { kNothing, kCertainty, kAngle, kOffset, kClearance, kDepth };

struct GradeLimits {
  double good_rad = 0.0349065850398866;  ///< 2°: below it is good
  double poor_rad = 0.0872664625997165;  ///< 5°: above it is poor, and dashed
  double good_offset_m = 0.001;          ///< of the tip from the planned axis, likewise
  double poor_offset_m = 0.002;

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// An angle that is not finite is poor.
[[nodiscard]] Grade grade_of(double angle_rad, const GradeLimits& limits = {});
[[nodiscard]] Grade grade_of_offset(double offset_m, const GradeLimits& limits = {});
[[nodiscard]] render::Colour colour_of(Grade grade);

/// `12.4°`, one decimal; `--.-°` for a value that is absent, not finite, negative or over 99.9°.
[[nodiscard]] std::string angle_text(std::optional<double> angle_rad);

/// The value that this text shows (rad); absent if it shows dashes.
[[nodiscard]] std::optional<double> read_angle_rad(std::optional<double> angle_rad);

enum class PathState { kRecording, kSaved };

/// H1: ribbon through consecutive samples. `opacity` in [0, 1] fades a deleted region out.
void add_sampled_path(render::Scene& scene, std::span<const render::Float3> samples,
                      PathState state, render::Label label, float opacity = 1.0f);

/// H1 once it is registered: green where a sample lies within 1 mm of the surface, amber within 2,
/// red beyond. One distance per sample; samples without one are left out.
void add_residual_path(render::Scene& scene, std::span<const render::Float3> samples,
                       std::span<const float> distances_m, render::Label label,
                       float opacity = 1.0f);
/// Opacity of a path while there are check points, which need the attention.
inline constexpr float kPathBehindChecks = 0.10f;

/// H2: the registered surface, bright where it turns away from the eye; in another colour where its
/// tints mark unstroked surface.
void add_vertebra(render::Scene& scene, std::shared_ptr<const render::MeshData> mesh,
                  const render::Matrix4& world_from_model, render::Label label);

enum class LabelSide { kLeft, kRight };  ///< as seen by the eyes

/// H3: sphere of 3 mm, ring of 6 mm in the plane of the bone, label such as `L4 left`.
struct EntryHologram {
  render::Float3 position{};
  render::Float3 surface_normal{};  ///< outward, any length
  std::string_view text;
  bool done = false;  ///< the screw is in: a tick behind the text
  LabelSide side = LabelSide::kRight;
};
void add_entry(render::Scene& scene, const EntryHologram& entry, render::Label label);

/// How far H4 extends out of the bone.
inline constexpr float kTrajectoryOutside_m = 0.060f;
/// The outer end of H4.
[[nodiscard]] render::Float3 trajectory_outer_end(render::Float3 entry, render::Float3 target);
/// H4: 2 mm wide from 60 mm outside to the entry, dashed from there to the target.
void add_planned_trajectory(render::Scene& scene, render::Float3 entry, render::Float3 target,
                            render::Label label);

/// Beside H4: a measured wire, solid from its outer end to the planned depth, with `text` at the
/// outer end; cyan, or red and in a red rim if it is beyond a limit.
void add_placed_wire(render::Scene& scene, render::Float3 outside, render::Float3 deep,
                     std::string_view text, bool within, render::Label label);

/// H5: A the entry, B on the tool's axis, C on the planned axis (`nav::ScrewGuidance`).
void add_deviation_triangle(render::Scene& scene, render::Float3 a, render::Float3 b,
                            render::Float3 c, Grade grade, render::Label label);

/// H6 where there is no cross: `text` (of angle_text) beside B, outward of it, so that it never
/// covers A.
void add_angle_readout(render::Scene& scene, render::Float3 a, render::Float3 b,
                       std::string_view text, Grade grade, render::Label label);
/// Replaces the number of a drawn angle by dashes.
void take_angle_off(render::TextItem& angle);

struct RodBendMark {
  render::Float3 position{};
  double angle_rad = 0.0;
  double arc_length_m = 0.0;  ///< from the rod's first end
  struct Making {
    double roll_rad = 0.0;
    double set_rad = 0.0;  ///< on the bender
  };
  std::optional<Making> making = {};  ///< absent: the shape is shown, not how it is made
};

/// H10. Make `tube` with render::make_tube once per rod and keep it: the renderer caches by
/// pointer.
struct RodHologram {
  std::shared_ptr<const render::MeshData> tube;  ///< world coordinates before `offset`
  std::span<const render::Float3> heads;
  std::span<const std::string_view> head_names;  ///< of the levels; none, or one per head
  std::span<const RodBendMark> bends;
  std::optional<double> length_m;  ///< absent: the heads make no rod
  bool to_cut = false;             ///< the length is what it is to be cut to
  bool first_bend_only = false;    ///< the other bends are rings without a text
  render::Float3 offset{};         ///< `move rod`: added to everything
};
void add_rod(render::Scene& scene, const RodHologram& rod, render::Label label);

/// `0.4 mm`, without a sign, one decimal; `-- mm` for a distance that is not finite.
[[nodiscard]] std::string distance_text(double distance_m);
/// H12: a diamond in a halo at a place touched to check the registration, with its distance from
/// the surface; green with a tick if near enough, otherwise red with a cross.
void add_check_point(render::Scene& scene, render::Float3 position, std::string_view text,
                     bool within, render::Label label);

/// H12: a place that was touched, but not the newest, without its distance: small and dim if it was
/// near enough, so that many of them leave the bone visible; otherwise red in its halo.
void add_earlier_check_point(render::Scene& scene, render::Float3 position, bool within,
                             render::Label label);

/// H12: the middle of what is to be stroked next: a ring from every side.
void add_place_to_stroke(render::Scene& scene, render::Float3 position, render::Label label);

/// H12: a place that is still to be touched.
void add_place_to_check(render::Scene& scene, render::Float3 position, render::Label label);

}  // namespace orthonav::engine
