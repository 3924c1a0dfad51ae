#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "base/transform.h"

namespace orthonav::engine {

/// A transform as ITK and 3D Slicer keep it in a file, before anybody asks what it does. Lengths
/// are millimetres, axes LPS. It takes coordinates in the frame of the node's *parent* to those of
/// the node ("from parent"), which is the inverse of what Slicer displays and of what it does to a
/// model below the node.
struct StoredTransform {
  std::string kind;  ///< ITK's class, with the type of its numbers: "AffineTransform_double_3_3"
  std::vector<double> parameters;
  std::vector<double> fixed_parameters;  ///< the centre; for Euler angles optionally their order
};

/// x_node = rotation · x_parent + translation; metres, LPS.
struct NodeFromParent {
  Mat3 rotation;
  Vec3 translation_m;
};

/// Refuses a kind that is not rigid, and one that is unknown.
[[nodiscard]] Status check_kind(const std::string& kind);

/// The motion of an affine transform, of Euler angles, a versor or a similarity, each with its
/// centre c: x -> R(x - c) + t + c (ITK Software Guide, "Transforms"). Refuses other kinds, numbers
/// that are too few, too many or not finite, and what is not rigid: rows that are not orthonormal
/// to 1e-4, a scale, a mirror image. The words follow a file's name.
[[nodiscard]] Result<NodeFromParent> node_from_parent(const StoredTransform& stored);

/// As ITK's affine transform with its centre at the origin.
[[nodiscard]] StoredTransform stored_from(const NodeFromParent& motion);

/// `parent_from_node` of such a file, the way a node of 3D Slicer moves what lies below it: the
/// inverse of what is stored. With a model below the node, Node is the model's frame.
template <class Parent, class Node>
[[nodiscard]] Result<Transform<Parent, Node>> parent_from_node(const StoredTransform& stored) {
  const auto motion = node_from_parent(stored);
  if (!motion) {
    return motion.error();
  }
  return Transform<Node, Parent>(motion->rotation, motion->translation_m).inverse();
}

/// What to store so that a node of 3D Slicer moves what lies below it by `parent_from_node`.
template <class Parent, class Node>
[[nodiscard]] StoredTransform stored(const Transform<Parent, Node>& parent_from_node) {
  const Transform<Node, Parent> motion = parent_from_node.inverse();
  return stored_from({motion.rotation(), motion.translation()});
}

}  // namespace orthonav::engine
