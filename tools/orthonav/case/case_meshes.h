#pragma once

#include <CLI/App.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/scan/mesh_case.h"

namespace orthonav::tools {

/// The options of `case make` for vertebrae whose meshes somebody else made.
class CaseMeshes {
 public:
  void add_to(CLI::App& command);
  [[nodiscard]] bool any() const { return !files_.empty(); }
  /// The levels in the unit and axes that their files or the options state. Refuses a file whose
  /// axes nobody states, as `mesh_levels` does, and meshes that do not lie on the bone of that scan
  /// ("": not checked). `unusual`: as in `check_places`.
  [[nodiscard]] Result<std::vector<engine::MeshLevel>> read(const std::string& volume,
                                                            const std::string& series,
                                                            std::string* unusual) const;

 private:
  std::vector<std::string> files_;
  std::string units_ = "mm";
  std::string frame_;
};

[[nodiscard]] engine::Case case_of(const std::vector<engine::MeshLevel>& made,
                                   const std::string& name);
[[nodiscard]] nlohmann::ordered_json levels_json(const std::vector<engine::MeshLevel>& made);
/// A line for each on standard output.
void print(const std::vector<engine::MeshLevel>& made);

}  // namespace orthonav::tools
