#pragma once

#include <vector>

#include "engine/live/bone_lines.h"
#include "engine/live/object_writer.h"

namespace orthonav::engine {

struct SceneObjectOptions {
  std::size_t path_pieces = 110;  ///< of all stroked paths together
  BoneLineOptions bone;
};

/// Converts each scene to objects for a display that draws them itself (ObjectDisplay). Lines
/// become thinned round pieces; spheres, diamonds and tubes stay; a bone surface becomes its
/// contours as seen from the head; texts face the head. Items that such a display can't show are
/// left out: the fill of the deviation triangle, rims of halos. One thread at a time.
class SceneObjects {
 public:
  explicit SceneObjects(const SceneObjectOptions& options = {})
      : options_(options), bone_(options.bone) {}

  /// Replaces the objects in `list`; the caller must set its map and tool time before: without a
  /// tool time, no object follows a tool. `head` is where the wearer's eyes are at `shown_at`.
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
