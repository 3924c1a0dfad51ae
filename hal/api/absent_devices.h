#pragma once

#include <vector>

#include "hal/api/devices.h"

namespace orthonav {

/// A button that is never pressed: there is none.
class AbsentClicker final : public Clicker {
  Status do_poll(Timestamp /*until*/, std::vector<ClickerEvent>& /*events*/) override { return {}; }
};

/// Nobody is listened to.
class AbsentVoice final : public Voice {
  Status do_poll(Timestamp /*until*/, std::vector<Phrase>& /*phrases*/) override { return {}; }
};

}  // namespace orthonav
