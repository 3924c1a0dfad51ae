#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/transform.h"
#include "nav/geometry/mesh.h"
#include "nav/guidance/screw_cylinder.h"

namespace orthonav::engine {

/// The vertebrae of an operation with their planned and placed screws, in one frame whose axes are
/// the patient's (LPS), as a section of a page in which a browser turns them (data/spine_view.js).
class SpineView {
 public:
  /// A mesh with more than 65,535 vertices is left out.
  template <class Frame>
  void add_bone(const nav::TriangleMesh& mesh, const Transform<Frame, Vertebra>& pose) {
    if (mesh.vertices_m.size() <= kMaxVertices) {
      bones_.push_back(mesh);
      for (Vec3& v : bones_.back().vertices_m) {
        v = (pose * Point<Vertebra>{v}).v;
      }
    }
  }
  template <class Frame>
  void add_planned(const nav::ScrewCylinder& screw, const Transform<Frame, Vertebra>& pose) {
    planned_.push_back(cylinder(screw, pose));
  }
  template <class Frame>
  void add_placed(const nav::ScrewCylinder& screw, const Transform<Frame, Vertebra>& pose) {
    placed_.push_back(cylinder(screw, pose));
  }
  /// `what`: a sentence on what lies where, as HTML. Empty where there is no bone.
  [[nodiscard]] std::string section(std::string_view heading, std::string_view what) const;

 private:
  static constexpr std::size_t kMaxVertices = 65535;  ///< an index has 16 bits

  struct Cylinder {
    Vec3 from_m;
    Vec3 to_m;
    double radius_m;
  };
  template <class Frame>
  static Cylinder cylinder(const nav::ScrewCylinder& screw,
                           const Transform<Frame, Vertebra>& pose) {
    return {(pose * screw.entry).v, (pose * (screw.entry + screw.length_m * screw.direction)).v,
            screw.radius_m};
  }
  [[nodiscard]] std::string data() const;

  std::vector<nav::TriangleMesh> bones_;  ///< in the common frame
  std::vector<Cylinder> planned_;
  std::vector<Cylinder> placed_;
};

}  // namespace orthonav::engine
