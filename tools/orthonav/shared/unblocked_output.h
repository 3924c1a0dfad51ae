#pragma once

#include <cstdint>
#include <cstdio>
#include <iosfwd>
#include <memory>
#include <string_view>

namespace orthonav::tools {

/// Writes to a terminal, a pipe or a file on a thread of its own, so that one that nobody reads
/// (Ctrl-S, a pager, a hung connection) or a slow disk stops nobody else. At most 64 KiB wait; then
/// the oldest are dropped and counted, and a line at that place says so. Thread-safe.
class UnblockedOutput {
 public:
  enum class Closes { kNever, kAtTheEnd };
  explicit UnblockedOutput(int descriptor, Closes closes);
  /// Waits for what is left, but only for a moment.
  ~UnblockedOutput();
  UnblockedOutput(const UnblockedOutput&) = delete;
  UnblockedOutput& operator=(const UnblockedOutput&) = delete;

  /// Adds a line, or several; never waits. A text that begins with '\r' is a line that is drawn
  /// again and again: the next one replaces it while it waits.
  void add(std::string_view text) noexcept;
  /// Waits for a moment; false if something is still waiting to be written then.
  bool settle();
  /// Texts that were dropped, or could not be written.
  [[nodiscard]] std::int64_t lost() const;
  /// The number of the first error of a write; 0: none.
  [[nodiscard]] int error_number() const;

 private:
  struct State;
  std::shared_ptr<State> state_;  ///< shared with the thread, which may hang in a write for ever
};

/// While it exists, whatever this process prints to standard error (`stderr`, std::cerr) goes
/// through an UnblockedOutput. Only one at a time. Other threads must not print while it begins or
/// ends.
class UnblockedStandardError {
 public:
  UnblockedStandardError();
  ~UnblockedStandardError();
  UnblockedStandardError(const UnblockedStandardError&) = delete;
  UnblockedStandardError& operator=(const UnblockedStandardError&) = delete;

  void add(std::string_view text) noexcept { output_.add(text); }

 private:
  UnblockedOutput output_;
  std::FILE* file_;
  std::FILE* stderr_before_;
  std::unique_ptr<std::streambuf> buffer_;
  std::streambuf* cerr_before_;
};

}  // namespace orthonav::tools
