#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "render/renderer.h"

namespace orthonav::render {

/// What the validation layer says, which must be nothing: otherwise the test fails when this goes.
/// Declare it before whatever reports to it, so that it hears of objects left behind as well.
class SilentValidation {
 public:
  SilentValidation() = default;
  ~SilentValidation() {
    std::string all;
    for (const std::string& message : *messages_) {
      all += "\n" + message;
    }
    if (!all.empty()) {
      ADD_FAILURE() << "validation:" << all;
    }
  }
  SilentValidation(const SilentValidation&) = delete;
  SilentValidation& operator=(const SilentValidation&) = delete;

  [[nodiscard]] const MessageSink& sink() const { return messages_; }

 private:
  MessageSink messages_ = std::make_shared<std::vector<std::string>>();
};

}  // namespace orthonav::render
