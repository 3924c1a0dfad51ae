#pragma once

#include <memory>
#include <utility>

#include "hal/api/forwarding_headset.h"

namespace orthonav {

/// Parts that replace a headset's own; null: its own is used.
struct OtherParts {
  std::unique_ptr<Clicker> clicker;
  std::unique_ptr<Voice> voice;
};

/// A headset with a clicker or a voice from elsewhere. Borrows the headset. Everything else is
/// passed through, including the name, which records in the log which cameras were used.
class JoinedHeadset : public ForwardingHeadset {
 public:
  JoinedHeadset(Headset& headset, OtherParts parts)
      : ForwardingHeadset(headset), parts_(std::move(parts)) {}
  [[nodiscard]] Clicker& clicker() override {
    return parts_.clicker ? *parts_.clicker : ForwardingHeadset::clicker();
  }
  [[nodiscard]] Voice& voice() override {
    return parts_.voice ? *parts_.voice : ForwardingHeadset::voice();
  }

 private:
  OtherParts parts_;
};

}  // namespace orthonav
