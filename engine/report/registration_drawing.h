#pragma once

#include <string>

#include "engine/report/depth_picture.h"
#include "engine/report/registration_scene.h"

namespace orthonav::engine {

/// One of the three views: its direction, and the anatomy at its edges.
struct RegistrationView {
  const char* name;  ///< "from behind"
  Viewpoint from;
  const char* left;
  const char* right;
  const char* top;
  const char* bottom;
  const char* remark = "";  ///< after the name in the caption
};

/// From behind, as seen by the surgeon; from the patient's left; from above, with the back below.
[[nodiscard]] std::array<RegistrationView, 3> registration_views();

/// An SVG element, millimetres.
struct RegistrationDrawing {
  std::string svg;
  Vec2 size_mm;
};

[[nodiscard]] std::string hex(Rgb colour);

/// Only the shaded bone with its touchable surface painted, and the names at the view's edges; the
/// element is left open for further drawing.
Result<RegistrationDrawing> bone_drawing(const RegisteredLevel& level,
                                         const RegistrationScene& scene,
                                         const RegistrationView& view, const SurfacePaint& paint);

/// The vertebra at the registered pose, the digitized points coloured by their distance to it, its
/// stroked surface, and the screws with their predicted errors, with the shaded bone as an embedded
/// picture.
Result<RegistrationDrawing> registration_drawing(const RegisteredLevel& level,
                                                 const RegistrationScene& scene,
                                                 const RegistrationView& view);

/// What the colours mean, as HTML.
[[nodiscard]] std::string registration_legend(const RegisteredLevel& level,
                                              const RegistrationScene& scene);

}  // namespace orthonav::engine
