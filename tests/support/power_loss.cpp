#include <algorithm>
#include <functional>

#include "base/random.h"
#include "engine/io/file_names.h"
#include "tests/support/memory_env.h"

namespace orthonav::test {
namespace {

using What = EnvCall::What;

constexpr std::size_t kBlock = 512;
constexpr std::size_t kAllCombinations = 6;
constexpr int kRandom = 16;

/// A change that is not durable yet: of a file's content, or of a name.
struct Change {
  bool of_a_name = false;
  std::size_t file = 0;
  std::size_t offset = 0;     ///< of the written bytes
  std::string bytes;          ///< empty: the file is truncated to `offset`
  std::string name;           ///< new name of the file; empty: none
  std::string no_longer;      ///< name that is removed; empty: none
  bool out_of_reach = false;  ///< a sync of it failed, so no later sync saves it
};

/// The disk, and what the kernel has not written yet.
class Disk {
 public:
  explicit Disk(const Files& files) {
    for (const auto& [name, content] : files) {
      names_[name] = live_names_[name] = contents_.size();
      contents_.push_back(content);
      sizes_.push_back(content.size());
    }
  }

  void apply(const EnvCall& call) {
    if (call.failed && call.what != What::kAppend && call.what != What::kSync) {
      return;
    }
    switch (call.what) {
      case What::kOpen:
        return open(call.path);
      case What::kAppend:
        return append(live_names_.at(call.path), call.bytes);
      case What::kTruncate:
        sizes_[live_names_.at(call.path)] = call.size;
        pending_.push_back({false, live_names_.at(call.path), call.size, "", "", ""});
        return;
      case What::kSync:
        return sync(live_names_.at(call.path), call.failed);
      case What::kRename:
        return name(live_names_.at(call.path), call.to, call.path);
      case What::kRemove:
        return name(0, "", call.path);
      case What::kSyncFolder:
        return sync_names(call.path);
    }
  }

  [[nodiscard]] std::size_t pending() const { return pending_.size(); }

  /// The files with the changes that survive.
  [[nodiscard]] Files left(const std::function<bool(std::size_t)>& survives,
                           bool old_blocks) const {
    auto names = names_;
    auto contents = contents_;
    for (std::size_t i = 0; i < pending_.size(); ++i) {
      if (survives(i)) {
        put(pending_[i], names, contents, old_blocks);
      }
    }
    Files files;
    for (const auto& [name, file] : names) {
      files[name] = contents[file];
    }
    return files;
  }

 private:
  using Names = std::map<std::string, std::size_t>;

  static void put(const Change& change, Names& names, std::vector<std::string>& contents,
                  bool old_blocks) {
    if (change.of_a_name) {
      if (!change.no_longer.empty()) {
        names.erase(change.no_longer);
      }
      if (!change.name.empty()) {
        names[change.name] = change.file;
      }
      return;
    }
    std::string& content = contents[change.file];
    if (change.bytes.empty()) {
      content.resize(change.offset);
      return;
    }
    const std::string old = content.substr(0, std::min(content.size(), kBlock));
    while (content.size() < change.offset) {
      content += old_blocks && !old.empty() ? old[content.size() % old.size()] : '\0';
    }
    content.resize(std::max(content.size(), change.offset + change.bytes.size()));
    content.replace(change.offset, change.bytes.size(), change.bytes);
  }

  void open(const std::string& path) {
    if (live_names_.count(path) == 0) {
      contents_.emplace_back();
      sizes_.push_back(0);
      name(contents_.size() - 1, path, "");
    }
  }

  void append(std::size_t file, std::string_view bytes) {
    while (!bytes.empty()) {
      const std::size_t room = kBlock - sizes_[file] % kBlock;
      const std::string_view piece = bytes.substr(0, room);
      pending_.push_back({false, file, sizes_[file], std::string(piece), "", ""});
      sizes_[file] += piece.size();
      bytes.remove_prefix(piece.size());
    }
  }

  void name(std::size_t file, const std::string& to, const std::string& from) {
    pending_.push_back({true, file, 0, "", to, from});
    if (!from.empty()) {
      live_names_.erase(from);
    }
    if (!to.empty()) {
      live_names_[to] = file;
    }
  }

  void sync(std::size_t file, bool failed) {
    settle([&](const Change& change) { return !change.of_a_name && change.file == file; }, failed);
  }

  void sync_names(const std::string& folder) {
    settle(
        [&](const Change& change) {
          return change.of_a_name &&
                 engine::folder_of(change.name.empty() ? change.no_longer : change.name) == folder;
        },
        false);
  }

  void settle(const std::function<bool(const Change&)>& meant, bool failed) {
    std::vector<Change> rest;
    for (Change& change : pending_) {
      if (!meant(change) || change.out_of_reach) {
        rest.push_back(std::move(change));
      } else if (failed) {
        change.out_of_reach = true;
        rest.push_back(std::move(change));
      } else {
        put(change, names_, contents_, false);
      }
    }
    pending_ = std::move(rest);
  }

  Names names_;                        ///< durable
  Names live_names_;                   ///< as a process sees them
  std::vector<std::string> contents_;  ///< durable, by file
  std::vector<std::size_t> sizes_;     ///< as a process sees them, by file
  std::vector<Change> pending_;
};

Disk disk_after(const Files& before, std::span<const EnvCall> calls) {
  Disk disk(before);
  for (const EnvCall& call : calls) {
    disk.apply(call);
  }
  return disk;
}

}  // namespace

Files after_kill(const Files& before, std::span<const EnvCall> calls) {
  return disk_after(before, calls).left([](std::size_t) { return true; }, false);
}

std::vector<Files> after_power_loss(const Files& before, std::span<const EnvCall> calls) {
  const Disk disk = disk_after(before, calls);
  const std::size_t n = disk.pending();
  std::vector<Files> all;
  const auto try_out = [&](const std::function<bool(std::size_t)>& survives) {
    all.push_back(disk.left(survives, false));
    all.push_back(disk.left(survives, true));
  };
  if (n <= kAllCombinations) {
    for (std::size_t mask = 0; mask < std::size_t{1} << n; ++mask) {
      try_out([&](std::size_t i) { return ((mask >> i) & 1u) != 0; });
    }
    return all;
  }
  for (std::size_t k = 0; k <= n; ++k) {
    try_out([&](std::size_t i) { return i < k; });
    try_out([&](std::size_t i) { return i != k; });
    try_out([&](std::size_t i) { return i == k; });
  }
  Random random(n);
  for (int k = 0; k < kRandom; ++k) {
    std::vector<bool> mask(n);
    std::generate(mask.begin(), mask.end(), [&] { return random.uniform() < 0.5; });
    try_out([&](std::size_t i) { return mask[i]; });
  }
  return all;
}

}  // namespace orthonav::test
