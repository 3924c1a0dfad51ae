#pragma once

#include "hal/fake/scripted.h"
#include "tools/preview/model.h"

namespace orthonav::preview {

/// A model with what it drives, on a clock of the test's own.
struct ModelBench {
  fake::ManualClock wall;
  Gate gate{wall};
  Keyboard keyboard;
  Timeline timeline;
  PreviewModel model{gate, keyboard, timeline};
};

}  // namespace orthonav::preview
