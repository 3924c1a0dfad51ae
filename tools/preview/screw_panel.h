#pragma once

#include "tools/preview/model.h"

namespace orthonav::preview {

/// The part of the panel that changes the planned screw being guided: buttons for one step each way
/// and the next sizes, and a line for any command. All of it is entered as speech.
void draw_screw(PreviewModel& model);

}  // namespace orthonav::preview
