#pragma once

#include <vector>

#include "hal/api/shared_button.h"
#include "hal/openxr/xr_display.h"

namespace orthonav::openxr {

/// The display's select button and the other headset's clicker as one button.
class SharedClicker : public Clicker {
 public:
  SharedClicker(XrDisplay& display, Clicker& inner) : display_(display), inner_(inner) {}

 private:
  Status do_poll(Timestamp until, std::vector<ClickerEvent>& events) override;

  XrDisplay& display_;
  Clicker& inner_;
  ClickTimer timer_;
  SharedButton button_;
  Timestamp told_ = Timestamp::min();  ///< no event may come before this
  std::vector<ButtonChange> changes_;
  std::vector<ClickerEvent> selected_;
  std::vector<ClickerEvent> clicked_;
};

}  // namespace orthonav::openxr
