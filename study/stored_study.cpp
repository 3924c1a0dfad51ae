#include "study/stored_study.h"

#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace orthonav::engine {
namespace {

/// A process may have some 1000 files open. If there are more files than this, each is reopened for
/// its next operation.
constexpr std::size_t kMaxOpen = 256;

/// Files of one study, each at its next operation.
class Files {
 public:
  Status open(std::span<const std::string> paths) {
    stay_open_ = paths.size() <= kMaxOpen;
    for (const std::string& path : paths) {
      files_.push_back({path, {}, {}});
      if (const Status status = advance(files_.size() - 1, -1); !status) {
        return status;
      }
    }
    return {};
  }
  /// The definition that all files share.
  [[nodiscard]] const std::string& definition() const { return definition_; }

  /// Nothing at the end.
  Result<std::optional<StoredOperation>> next() {
    std::optional<StoredOperation> found;
    while (!order_.empty() && (!found || order_.begin()->first == found->index)) {
      const std::size_t file = order_.begin()->second;
      order_.erase(order_.begin());
      StoredOperation here = std::move(*std::exchange(files_[file].next, {}));
      if (found && found->report != here.report) {
        return Error{files_[file].path + ": operation " + std::to_string(here.index) +
                     " has another result than in the other files"};
      }
      if (const Status status = advance(file, here.index); !status) {
        return status.error();
      }
      if (!found) {
        found = std::move(here);
      }
    }
    return found;
  }

 private:
  struct File {
    std::string path;
    std::optional<StudyStore> store;  ///< where it is open
    std::optional<StoredOperation> next;
  };

  Status open(File& file) {
    auto store = StudyStore::read(file.path);
    if (!store) {
      return store.error();
    }
    if (!definition_.empty() && definition_ != store->definition()) {
      return Error{file.path + ": holds study " + study_hash(store->definition()) +
                   ", the others hold " + study_hash(definition_)};
    }
    definition_ = store->definition();
    file.store = std::move(*store);
    return {};
  }

  Status advance(std::size_t which, int after) {
    File& file = files_[which];
    if (!file.store) {
      if (const Status opened = open(file); !opened) {
        return opened;
      }
    }
    auto next = file.store->next_after(after);
    if (!stay_open_) {
      file.store.reset();
    }
    if (!next) {
      return next.error();
    }
    file.next = std::move(*next);
    if (file.next) {
      order_.emplace(file.next->index, which);
    }
    return {};
  }

  bool stay_open_ = true;
  std::string definition_;
  std::vector<File> files_;
  std::set<std::pair<int, std::size_t>> order_;
};

}  // namespace

Result<std::string> for_each_operation(std::span<const std::string> paths,
                                       const std::function<Status(const StoredOperation&)>& take) {
  Files files;
  if (const Status opened = files.open(paths); !opened) {
    return opened.error();
  }
  for (;;) {
    const auto operation = files.next();
    if (!operation) {
      return operation.error();
    }
    if (!*operation) {
      return files.definition();
    }
    if (const Status taken = take(**operation); !taken) {
      return taken.error();
    }
  }
}

}  // namespace orthonav::engine
