#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/case/prepared_parts_file.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {

/// Vertebrae prepared for registration, stored in files (engine/case/prepared_parts_file.h) so that
/// the next session has them at once: in a folder, one per mesh, named by its checksums. An invalid
/// file (damaged, foreign, of another version) is replaced and causes only a note. The result is
/// the same to the bit, whether from a file or not.
class ModelCache {
 public:
  /// Without a folder nothing is stored. The folder is created when there is something to store.
  explicit ModelCache(std::string folder = {}) : folder_(std::move(folder)) {}

  /// Loads or prepares; an Error means that the mesh is not a vertebra. Writes nothing.
  Result<std::shared_ptr<const nav::VertebraModel>> prepared(const nav::TriangleMesh& mesh);
  /// Writes the newly prepared models. A separate step, so that a command refused in between leaves
  /// no files.
  void keep();

  /// What went wrong: one line for each file that could not be used or written.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  [[nodiscard]] int loaded() const { return loaded_; }
  [[nodiscard]] int made() const { return made_; }

 private:
  struct Unwritten {
    MeshKey key;
    std::shared_ptr<const nav::VertebraModel> model;
  };
  [[nodiscard]] std::string file_of(const MeshKey& key) const;
  [[nodiscard]] std::shared_ptr<const nav::VertebraModel> load(const nav::TriangleMesh& mesh,
                                                               const MeshKey& key);

  std::string folder_;
  std::vector<Unwritten> unwritten_;
  std::vector<std::string> notes_;
  int loaded_ = 0;
  int made_ = 0;
};

}  // namespace orthonav::engine
