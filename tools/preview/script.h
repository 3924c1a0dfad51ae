#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "tools/preview/model.h"

namespace orthonav::preview {

/// What a script needs from the program that runs it.
struct ScriptStage {
  std::function<void(int width_px, int height_px)> resize;
  std::function<void(const std::string& name)> screenshot;
};

/// A line of a script: a word and what follows it.
struct ScriptLine {
  int number = 0;
  std::string word;
  std::string rest;
};

/// What follows a word: numbers are whole or any.
enum class Follows : std::uint8_t {
  kNothing,
  kText,
  kKey,
  kWhole,
  kNumber,
  kTwoWhole,
  kTwoNumbers
};
/// A word that a line can begin with.
struct ScriptWord {
  std::string_view word;
  Follows follows = Follows::kNothing;
  double low = 0.0;  ///< of its numbers
  double high = 0.0;
};
/// The window's size in pixels.
inline constexpr ScriptWord kResize{"resize", Follows::kTwoWhole, 64, 16'384};
/// Those of a previewed operation.
[[nodiscard]] std::span<const ScriptWord> script_words();
/// One or two numbers; nothing if there are others, or more.
[[nodiscard]] std::optional<std::array<double, 2>> numbers_in(const std::string& text, int count);

/// Synthetic input from a file, line by line; docs/preview.md lists the words. It acts through
/// the same calls as keys and mouse.
class Script {
 public:
  /// Refuses lines that do not begin with one of the words, with file and line number.
  static Result<Script> load(const std::filesystem::path& path,
                             std::span<const ScriptWord> words = script_words());
  static Result<Script> parse(const std::string& text, const std::string& name,
                              std::span<const ScriptWord> words = script_words());

  /// Performs the lines that are due, up to the first one that must wait; the next call continues
  /// there. `now` is wall time: a line that waits too long is an Error. `ended`: nothing more will
  /// come.
  Status advance(PreviewModel& model, const ScriptStage& stage, Timestamp now, bool ended);
  /// The same where nothing is waited for: performs lines up to the next picture, or to the first
  /// Error, to which file, line and word are added.
  Status advance(const std::function<Status(const ScriptLine&)>& perform);
  [[nodiscard]] bool done() const { return next_ == lines_.size(); }

 private:
  Script(std::string name, std::vector<ScriptLine> lines)
      : name_(std::move(name)), lines_(std::move(lines)) {}
  [[nodiscard]] Status check(const ScriptLine& line, std::span<const ScriptWord> words) const;
  [[nodiscard]] Status check_numbers(const ScriptLine& line, const ScriptWord& word) const;
  [[nodiscard]] Error error(const ScriptLine& line, const std::string& why) const;
  /// False: it must wait and be tried again.
  bool perform(const ScriptLine& line, PreviewModel& model, const ScriptStage& stage);
  bool reaches_pair(std::int64_t pair, bool absolute, PreviewModel& model);

  std::string name_;
  std::vector<ScriptLine> lines_;
  std::size_t next_ = 0;
  std::optional<Timestamp> waits_since_;
  std::optional<std::int64_t> wait_for_pair_;
  int waited_ = 0;  ///< pictures
};

}  // namespace orthonav::preview
