#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
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

/// Every word that a line can begin with.
[[nodiscard]] std::vector<std::string_view> script_words();

/// Synthetic input from a file, line by line; docs/preview.md lists the words. It acts through
/// the same calls as keys and mouse.
class Script {
 public:
  /// Refuses unknown lines, with file and line number.
  static Result<Script> load(const std::filesystem::path& path);
  static Result<Script> parse(const std::string& text, const std::string& name);

  /// Performs the lines that are due, up to the first one that must wait; the next call continues
  /// there. `now` is wall time: a line that waits too long is an Error. `ended`: nothing more will
  /// come.
  Status go_on(PreviewModel& model, const ScriptStage& stage, Timestamp now, bool ended);
  [[nodiscard]] bool done() const { return next_ == lines_.size(); }

 private:
  Script(std::string name, std::vector<ScriptLine> lines)
      : name_(std::move(name)), lines_(std::move(lines)) {}
  [[nodiscard]] Status check(const ScriptLine& line) const;
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
