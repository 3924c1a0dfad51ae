#pragma once

namespace orthonav::preview {

/// Colours and font of Dear ImGui's present context: dark, so that the picture is what is seen. The
/// font is the system's DejaVu Sans where it is there.
void set_look_and_feel();

}  // namespace orthonav::preview
