#pragma once

#include <vector>

#include "hal/openxr/xr_display.h"

namespace orthonav::openxr {

/// The display's select button and the other headset's clicker as one button: who presses first has
/// it until the release, and what the other does meanwhile is lost.
class SharedClicker : public Clicker {
 public:
  SharedClicker(XrDisplay& display, Clicker& inner) : display_(display), inner_(inner) {}

 private:
  enum class Hand { kNobody, kDisplay, kInner };
  Status do_poll(Timestamp until, std::vector<ClickerEvent>& events) override;
  void offer(Hand hand, const ClickerEvent& event, std::vector<ClickerEvent>& events);

  XrDisplay& display_;
  Clicker& inner_;
  ClickTimer timer_;
  ButtonState state_;
  Hand hand_ = Hand::kNobody;
  Timestamp told_ = Timestamp::min();  ///< nothing comes before it any more
  std::vector<ButtonChange> changes_;
  std::vector<ClickerEvent> selected_;
  std::vector<ClickerEvent> clicked_;
};

}  // namespace orthonav::openxr
