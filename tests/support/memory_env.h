#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "engine/io/env.h"

namespace orthonav::test {

/// Files by name. The part before a name's last slash is its folder.
using Files = std::map<std::string, std::string>;

/// A call that changes something, as far as it was executed.
struct EnvCall {
  enum class What { kOpen, kAppend, kSync, kRename, kTruncate, kRemove, kSyncFolder };
  What what = What::kOpen;
  std::string path;
  std::string to;     ///< of a rename
  std::string bytes;  ///< that were appended
  std::size_t size = 0;
  bool failed = false;
};

/// A file system in memory that remembers every change, and fails on request.
class MemoryEnv : public engine::Env {
 public:
  MemoryEnv() : MemoryEnv(Files{}) {}
  explicit MemoryEnv(Files files);

  /// The n-th change, counted from 0, fails with this error, and with `from_then_on` all later ones
  /// too. A failing append writes half of its bytes.
  void fail_at(std::size_t n, int error_number, bool from_then_on);
  /// The same for the n-th look, counted from 0: a `read`, a `list` or a `lock`. Later ones work
  /// again.
  void fail_look_at(std::size_t n, int error_number);
  [[nodiscard]] std::size_t looks() const { return looks_; }
  [[nodiscard]] const std::vector<EnvCall>& calls() const { return calls_; }
  [[nodiscard]] Files files() const;

  Result<std::unique_ptr<engine::AppendFile>> open_append(const std::string& path) override;
  Result<std::string> read(const std::string& path, std::size_t most_bytes) override;
  Result<std::vector<std::string>> list(const std::string& folder) override;
  Status rename(const std::string& from, const std::string& to) override;
  Status truncate(const std::string& path, std::size_t bytes) override;
  Status remove(const std::string& path) override;
  Status sync_folder(const std::string& folder) override;
  Result<std::unique_ptr<engine::FolderLock>> lock(const std::string& folder) override;

 private:
  friend class MemoryFile;
  using Content = std::shared_ptr<std::string>;

  /// Remembers the call; the number of the error that it ends with, or 0.
  int call(EnvCall call);
  /// Counts the look; the number of the error that it ends with, or 0.
  int look();

  std::map<std::string, Content> files_;
  std::vector<EnvCall> calls_;
  std::optional<std::size_t> fail_at_;
  int error_number_ = 0;
  bool from_then_on_ = false;
  std::size_t looks_ = 0;
  std::optional<std::size_t> fail_look_at_;
  int look_error_number_ = 0;
  std::shared_ptr<std::set<std::string>> locked_;
};

/// The files after a process was killed after these calls: the kernel writes the rest.
[[nodiscard]] Files after_kill(const Files& before, std::span<const EnvCall> calls);

/// All states of the disk that are possible when power is lost after these calls. Anything not
/// synced may be there or not: each name, and each block of 512 bytes of each write, in any order;
/// a block that is missing in the middle holds zeros, or what an old block of the same file held.
/// With few such changes, every combination; with many, those torn anywhere, those that lack one or
/// have only one, and some at random.
[[nodiscard]] std::vector<Files> after_power_loss(const Files& before,
                                                  std::span<const EnvCall> calls);

}  // namespace orthonav::test
