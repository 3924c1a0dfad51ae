#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace orthonav::engine {

/// The words of a phrase, split at spaces, in lower case.
[[nodiscard]] std::vector<std::string> words_of(std::string_view phrase);

/// Reads spoken and typed numbers from words, one after another. Words that it does not understand
/// are not consumed.
class NumberWords {
 public:
  explicit NumberWords(std::span<const std::string> words) : words_(words) {}

  /// "six", "forty five", "twelve point five", "half", "two and a half", "6.5": from 0 to 99.9.
  [[nodiscard]] std::optional<double> take();
  /// A diameter as surgeons say it before a length: also "six five" for 6.5 if another number
  /// follows.
  [[nodiscard]] std::optional<double> take_diameter();
  /// Takes the next word if it is one of these.
  [[nodiscard]] bool take_word(std::span<const std::string_view> any_of);
  [[nodiscard]] bool at_end() const { return next_ == words_.size(); }

 private:
  [[nodiscard]] std::string_view word(std::size_t ahead = 0) const {
    return next_ + ahead < words_.size() ? std::string_view(words_[next_ + ahead])
                                         : std::string_view();
  }
  [[nodiscard]] std::optional<double> take_whole();
  [[nodiscard]] double take_fraction();

  std::span<const std::string> words_;
  std::size_t next_ = 0;
};

}  // namespace orthonav::engine
