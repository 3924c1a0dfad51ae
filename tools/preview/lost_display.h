#pragma once

namespace orthonav::preview {

/// An X server that goes away ends the process, unless someone watches. To be called once GLFW has
/// its display; afterwards `display_is_lost` tells, and calls that need the display do nothing.
void watch_display();
[[nodiscard]] bool display_is_lost();

}  // namespace orthonav::preview
