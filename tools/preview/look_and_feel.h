#pragma once

namespace orthonav::preview {

/// Colours and font for Dear ImGui's current context: dark, so that the picture stands out. The
/// font is the system's DejaVu Sans where it exists.
void set_look_and_feel();

}  // namespace orthonav::preview
