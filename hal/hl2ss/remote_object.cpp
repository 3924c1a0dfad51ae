#include "hal/hl2ss/remote_object.h"

#include <cmath>

namespace orthonav::hl2ss {
namespace {

constexpr double kSmallestMoveM = 5e-5;
/// Of a quaternion's components, half an angle: 1 mrad moves what is 5 cm away by 0.05 mm.
constexpr double kSmallestRotation_rad = 5e-4;
constexpr double kSmallestScale = 5e-5;

}  // namespace

bool is_moved(const DisplayObject& told, const DisplayObject& wanted) {
  const Quaternion& a = told.rotation;
  const Quaternion& b = wanted.rotation;
  const double rotation_rad =
      std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z) + std::abs(a.w - b.w);
  return told.place != wanted.place ||
         (told.position_m - wanted.position_m).norm() > kSmallestMoveM ||
         rotation_rad > kSmallestRotation_rad ||
         (told.scale - wanted.scale).norm() > kSmallestScale;
}

bool looks_different(const DisplayObject& told, const DisplayObject& wanted) {
  return told.colour != wanted.colour || told.text != wanted.text ||
         std::abs(told.cap_height_m - wanted.cap_height_m) > kSmallestScale;
}

}  // namespace orthonav::hl2ss
