#pragma once

namespace orthonav::engine {

/// What a session asks of the surgeon beside strokes and looks. Each can be left out alone, so that
/// a study can tell what it gains (docs/decisions/0076-one-step-left-out.md); an operation has all
/// of them, or, where the eye alone verifies, none.
struct MethodSteps {
  bool check_points = true;  ///< places of the bone, touched in `verify`, join the registration
  bool landmark = true;      ///< is touched again before each screw
  bool tips = true;          ///< the guide's is held against the pointer's, in the landmark
  bool wire = true;          ///< is measured where it was placed, with the sleeve
  bool redo = true;          ///< of a wire beyond a limit, through another entry
  bool axis = true;          ///< of the guide is corrected by its sleeve, turned on a wire

  /// Something is touched in `accepted`.
  [[nodiscard]] constexpr bool dimple() const { return landmark || tips; }
  [[nodiscard]] static constexpr MethodSteps none() {
    return {false, false, false, false, false, false};
  }
};

}  // namespace orthonav::engine
