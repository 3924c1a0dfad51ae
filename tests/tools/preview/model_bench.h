#pragma once

#include "hal/fake/scripted.h"
#include "tools/preview/model.h"

namespace orthonav::preview {

/// A model with the parts that it drives, on the test's own clock.
struct ModelBench {
  fake::ManualClock wall;
  Gate gate{wall};
  Keyboard keyboard;
  Timeline timeline;
  PreviewModel model{gate, keyboard, timeline};
};

}  // namespace orthonav::preview
