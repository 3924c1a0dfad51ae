#pragma once

#include "tests/support/voxelised_body.h"

namespace orthonav::test {

/// Puts a bone into the body where it lies: cortex outside, textured cancellous bone inside.
void put_bone(const BodyBone& bone, const BodySettings& settings, FineBody& body);

}  // namespace orthonav::test
