#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/tools/command_line.h"

namespace orthonav::test {

/// A case of one level named L5, which is read in a fraction of the time that the phantom takes.
/// With another bone it is a case of another patient.
void write_one_level_case(const std::filesystem::path& folder, const std::string& bone = "L5");

/// `orthonav run` of three recorded pairs that writes everything a run can write.
class ShortRun {
 public:
  ShortRun();

  /// Runs in new folders; the new process calls `prepare` first. Code -1 if it crashed or hung for
  /// a minute.
  Called run(const std::function<void()>& prepare);

  /// Everything that the run writes is below this folder.
  [[nodiscard]] const std::string& written() const { return written_; }
  [[nodiscard]] std::string out() const { return written_ + "/out"; }
  /// The path of the recording: under its name or, cut off, under the temporary one; empty if there
  /// is none.
  [[nodiscard]] std::string recording() const;
  [[nodiscard]] std::string log() const { return written_ + "/log.txt"; }
  [[nodiscard]] std::string list() const { return folder_.file("calls"); }

  static constexpr int kPairs = 3;

 private:
  ScratchFolder folder_;
  std::string written_ = folder_.file("written");
};

/// Whether every result exists, is complete, and covers the whole run.
[[nodiscard]] bool all_is_kept(const ShortRun& run);

/// Expects everything that exists to be readable: reports are whole or absent, log and
/// recording are read to their last whole line, record and pair.
void expect_readable(const ShortRun& run);

}  // namespace orthonav::test
