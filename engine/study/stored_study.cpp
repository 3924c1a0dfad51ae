#include "engine/study/stored_study.h"

#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace orthonav::engine {
namespace {

/// Files that lie open, each at its next operation.
class OpenFiles {
 public:
  Status open(std::span<const std::string> paths, std::string& definition) {
    for (const std::string& path : paths) {
      auto store = StudyStore::read(path);
      if (!store) {
        return store.error();
      }
      if (!definition.empty() && definition != store->definition()) {
        return Error{path + ": holds study " + study_hash(store->definition()) +
                     ", the others hold " + study_hash(definition)};
      }
      definition = store->definition();
      stores_.push_back({path, std::move(*store), {}});
      if (const Status status = advance(stores_.size() - 1, -1); !status) {
        return status;
      }
    }
    return {};
  }

  /// Nothing at the end.
  Result<std::optional<StoredOperation>> next() {
    std::optional<StoredOperation> found;
    while (!order_.empty() && (!found || order_.begin()->first == found->index)) {
      const std::size_t file = order_.begin()->second;
      order_.erase(order_.begin());
      StoredOperation here = std::move(*std::exchange(stores_[file].next, {}));
      if (found && found->report != here.report) {
        return Error{stores_[file].path + ": operation " + std::to_string(here.index) +
                     " has another result than in the other files"};
      }
      if (const Status status = advance(file, here.index); !status) {
        return status.error();
      }
      found = found ? std::move(found) : std::optional(std::move(here));
    }
    return found;
  }

 private:
  struct File {
    std::string path;
    StudyStore store;
    std::optional<StoredOperation> next;
  };

  Status advance(std::size_t file, int after) {
    auto next = stores_[file].store.next_after(after);
    if (!next) {
      return next.error();
    }
    stores_[file].next = std::move(*next);
    if (stores_[file].next) {
      order_.emplace(stores_[file].next->index, file);
    }
    return {};
  }

  std::vector<File> stores_;
  std::set<std::pair<int, std::size_t>> order_;
};

}  // namespace

Result<std::string> for_each_operation(std::span<const std::string> paths,
                                       const std::function<Status(const StoredOperation&)>& take) {
  std::string definition;
  OpenFiles files;
  if (const Status opened = files.open(paths, definition); !opened) {
    return opened.error();
  }
  for (;;) {
    const auto operation = files.next();
    if (!operation) {
      return operation.error();
    }
    if (!*operation) {
      return definition;
    }
    if (const Status taken = take(**operation); !taken) {
      return taken.error();
    }
  }
}

}  // namespace orthonav::engine
