#pragma once

#include <vector>

#include "engine/live/bone_lines.h"
#include "engine/live/object_writer.h"

namespace orthonav::engine {

struct SceneObjectOptions {
  std::size_t path_pieces = 110;  ///< of all stroked paths together
  BoneLineOptions bone;
};

/// Makes of each scene the objects of a display that draws on its own (ObjectDisplay). Lines become
/// round pieces, thinned; spheres, diamonds and tubes what they are; a surface of bone its contours
/// as the head sees it; texts face the head. What such a display can't show is left out: the fill
/// of the deviation triangle, rims of halos. One thread at a time.
class SceneObjects {
 public:
  explicit SceneObjects(const SceneObjectOptions& options = {})
      : options_(options), bone_(options.bone) {}

  /// In place of the objects that `list` holds; its map and time of the tool are the caller's, and
  /// must be there already: without a tool's time nothing counts as hanging on it. `head` is where
  /// the wearer's eyes are when it is shown, at `shown_at`.
  void write(const render::Scene& scene, const render::Head& head, Timestamp shown_at,
             ObjectList& list);

 private:
  void add_mesh(const render::MeshItem& item, render::Float3 eye, Timestamp shown_at);
  void add_line(const render::LineItem& item, const std::vector<StraightPiece>& pieces);
  void add_outline(const render::TriangleItem& item);
  [[nodiscard]] std::vector<std::vector<StraightPiece>> thinned_paths(const render::Scene& scene);

  SceneObjectOptions options_;
  BoneLines bone_;
  ObjectWriter writer_;
  float path_within_m_ = 0;
};

}  // namespace orthonav::engine
