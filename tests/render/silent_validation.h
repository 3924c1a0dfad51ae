#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "render/renderer.h"

namespace orthonav::render {

/// Collects messages of the validation layer; the test fails when this is destroyed after any
/// message. Declare it before the objects that report to it, so that it also notices objects left
/// behind.
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
