#pragma once

namespace orthonav::engine {

/// What a session asks of the surgeon besides strokes and looks. Each can be left out on its own,
/// so that a study can measure its benefit (docs/decisions/0076-one-step-left-out.md); an operation
/// has all of them or, if verification is by eye alone, none.
struct MethodSteps {
  bool check_points = true;  ///< places of the bone touched in `verify` join the registration
  bool landmark = true;      ///< the landmark is touched again before each screw
  bool tips = true;          ///< the guide's tip is compared with the pointer's in the landmark
  bool wire = true;          ///< the placed wire is measured with the sleeve
  bool redo = true;          ///< a wire beyond a limit is redone through another entry
  bool axis = true;          ///< the guide's axis is corrected by its sleeve, turned on a wire

  /// Whether anything is touched in `accepted`.
  [[nodiscard]] constexpr bool dimple() const { return landmark || tips; }
  [[nodiscard]] static constexpr MethodSteps none() {
    return {false, false, false, false, false, false};
  }
};

}  // namespace orthonav::engine
