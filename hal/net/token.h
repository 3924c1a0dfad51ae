#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "base/result.h"

namespace orthonav::net {

/// A secret that whoever connects must bring: 16 to 128 letters, digits, '-' and '_'.
class Token {
 public:
  /// None: nobody is asked for one.
  Token() = default;
  /// From a file, which must be readable only by its owner; if it does not exist, it is made with a
  /// random token.
  static Result<Token> of(const std::string& path);

  [[nodiscard]] bool is_asked_for() const { return !text_.empty(); }
  /// Whether this is it, in constant time for every text of the right length; never if there is
  /// none.
  [[nodiscard]] bool is(std::string_view text) const;
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  explicit Token(std::string text) : text_(std::move(text)) {}
  std::string text_;
};

}  // namespace orthonav::net
