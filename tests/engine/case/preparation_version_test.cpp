#include <gtest/gtest.h>

#include "engine/phantom/phantom.h"
#include "nav/registration/registration.h"

namespace orthonav::engine {
namespace {

using nav::PreparedParts;
using nav::VertebraModel;

/// A summary of the prepared data of a known bone. When this fails, the same mesh is prepared
/// differently than before: raise nav::kPreparationVersion, so that earlier files are not used, and
/// put the new figures here.
TEST(PreparationVersion, IsRaisedWithEveryChangeOfThePreparation) {
  const auto model = VertebraModel::prepare(phantom({"L4"}).levels.at(0).mesh).value();
  const PreparedParts parts = model->parts();
  double faces = 0.0;
  double closest_m = 0.0;
  double distance_m = 0.0;
  for (std::size_t i = 0; i < parts.reachable.size(); ++i) {
    faces += parts.reachable[i];
  }
  for (const Vec3& p : parts.closest_m) {
    closest_m += p.norm();
  }
  for (const float d : parts.distance_m) {
    distance_m += static_cast<double>(d);
  }
  EXPECT_EQ(nav::kPreparationVersion, 2u);
  EXPECT_EQ(parts.reachable.size(), 9675u);
  EXPECT_EQ(parts.closest_m.size(), 35588u);
  EXPECT_EQ(parts.distance_m.size(), 84952u);
  // The same to the bit with every compiler so far; this tolerance allows for other libraries'
  // sines.
  constexpr double kRelative = 1e-9;
  EXPECT_NEAR(faces, 79674415.0, kRelative * faces);
  EXPECT_NEAR(closest_m, 1696.4018681262553, kRelative * closest_m);
  EXPECT_NEAR(distance_m, 1652.0045668144214, kRelative * distance_m);
}

}  // namespace
}  // namespace orthonav::engine
