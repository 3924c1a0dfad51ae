#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/evaluation/slice_plane.h"
#include "engine/planning/plan_editor.h"
#include "tools/preview/camera.h"
#include "tools/preview/planning/plan_keys.h"

namespace orthonav::preview {

/// The four pictures of a plan: upper left, upper right, lower left, lower right.
enum class Pane : std::uint8_t { kAxial, kSagittal, kAcross, kSpace };
inline constexpr std::size_t kPanes = 4;
/// "axial", "sagittal", "across", "space".
[[nodiscard]] const char* name_of(Pane pane);

/// A place in a pane: to the right of and above its middle, as fractions of its height.
struct PanePlace {
  Pane pane = Pane::kAxial;
  Vec2 at;
};
/// `at`: from the upper left of the four, as fractions of their height; `aspect`: their width by
/// their height.
[[nodiscard]] PanePlace pane_place(Vec2 at, double aspect);

/// Requests that only the surrounding program can fulfil.
struct PlanWishes {
  bool screenshot = false;
  bool save = false;
  bool quit = false;
  bool discard = false;  ///< quit without saving
};

/// What keys, mouse and panel do while a plan is edited, without a window: these and scripts make
/// the same calls. One thread.
class PlanModel {
 public:
  /// `editor` must outlive it.
  explicit PlanModel(engine::PlanEditor& editor);

  void key(Key key, bool down);
  /// A change in words (`engine::PlanEditor::say`); its refusal becomes the note.
  void say(std::string_view phrase);
  void select(const engine::ScrewPlace& place);

  /// Quits without saving, at once if nothing is lost by it, else at the second call in a row.
  void discard();

  // The mouse, over the four panes of that aspect.
  void set_aspect(double aspect) { aspect_ = aspect; }
  /// Moves it; what is held follows.
  void move(Vec2 at);
  /// A button goes down: holds what is there. In the slices that is entry, target or the whole
  /// screw, beside them the scan's window, in space the view.
  void press();
  void release();
  /// The wheel. Axial and sagittal: larger; across: 1 mm a step, downward
  /// is deeper; in space: nearer.
  void scroll(double steps);

  /// Holds a part of the screw in a slice as `press` does, and moves it by this much in the slice,
  /// metres. For scripts. False: nothing is there, or no screw can lie there.
  bool drag(Pane pane, nav::ScrewPart part, Vec2 by_m);

  /// The slices of the selected screw. While it is dragged they stay.
  [[nodiscard]] const engine::ScrewSlices& slices() const { return slices_; }
  [[nodiscard]] const engine::SlicePlane& slice(Pane pane) const;
  /// The densities that are drawn black and white: to the right wider, upward brighter.
  [[nodiscard]] const engine::GreyWindow& window() const { return window_; }
  /// Whether a scan lies behind the slices.
  [[nodiscard]] bool over_scan() const { return over_scan_; }
  void set_over_scan(bool over_scan) { over_scan_ = over_scan; }
  /// Of the slice across the screw, past the entry.
  [[nodiscard]] double across_m() const { return across_m_; }
  /// The view in space: from below and a little from behind, the patient's right on the left as in
  /// the slices.
  [[nodiscard]] Transform<Vertebra, Eye> vertebra_from_eye() const;

  [[nodiscard]] engine::PlanEditor& editor() const { return editor_; }
  [[nodiscard]] const std::string& note() const { return note_; }
  void set_note(std::string note) { note_ = std::move(note); }
  [[nodiscard]] bool panel() const { return panel_; }
  [[nodiscard]] bool help() const { return help_; }
  [[nodiscard]] PlanWishes& wishes() { return wishes_; }
  [[nodiscard]] PlanWishes take_wishes() { return std::exchange(wishes_, {}); }
  /// Whether the pictures have changed since the last call.
  [[nodiscard]] bool take_changed() { return std::exchange(changed_, false); }

 private:
  void look_anew();
  void reset_views();
  [[nodiscard]] std::optional<nav::ScrewPart> part_at(const PanePlace& place) const;
  void tell(const Status& status);
  void change_window(Vec2 by);
  bool drag_to(Vec2 in_plane_m);

  engine::PlanEditor& editor_;
  double aspect_ = 1.0;
  Vec2 cursor_{};
  std::optional<Pane> held_in_;    ///< the pane where the button went down
  Vec2 held_at_m_{};               ///< in that slice: where it did
  Vec2 drawn_to_m_{};              ///< and where the mouse is now
  std::optional<double> depth_m_;  ///< of the slice across, as scrolled; none: where it is nearest
  double across_m_ = 0.0;
  double magnification_ = 1.0;
  engine::ScrewSlices slices_;
  engine::GreyWindow window_ = engine::kBoneWindow;
  bool over_scan_ = false;
  bool asked_to_discard_ = false;
  Camera camera_;
  std::string note_;
  bool panel_ = true;
  bool help_ = false;
  bool changed_ = true;
  PlanWishes wishes_;
};

}  // namespace orthonav::preview
