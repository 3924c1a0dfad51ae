#pragma once

#include <vector>

#include "hal/api/devices.h"

namespace orthonav {

/// Stands in where there is no button: never pressed.
class AbsentClicker final : public Clicker {
  Status do_poll(Timestamp /*until*/, std::vector<ClickerEvent>& /*events*/) override { return {}; }
};

/// Stands in where there is no voice recognition: hears nothing.
class AbsentVoice final : public Voice {
  Status do_poll(Timestamp /*until*/, std::vector<Phrase>& /*phrases*/) override { return {}; }
};

}  // namespace orthonav
