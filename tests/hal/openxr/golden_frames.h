#pragma once

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "engine/golden/golden_scenes.h"
#include "tests/support/openxr_runtime/runtime_double.h"

namespace orthonav::test::presenting_test {

/// The golden scene of that name.
inline const engine::GoldenScene& golden(const std::string& name) {
  static const std::vector<engine::GoldenScene> kScenes = engine::golden_scenes();
  for (const engine::GoldenScene& scene : kScenes) {
    if (scene.name == name) {
      return scene;
    }
  }
  ADD_FAILURE() << "no golden scene " << name;
  return kScenes.front();
}

/// The head pose that sees a golden scene as in its picture.
inline Transform<World, Rig> head_of(const engine::GoldenScene& scene) {
  std::array<double, 16> rows{};
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) {
      rows[static_cast<std::size_t>(4 * r + c)] =
          static_cast<double>(scene.views.front().eye_from_world[c][r]);
    }
  }
  const auto eye_from_world = Transform<Rig, World>::from_row_major(rows);
  EXPECT_TRUE(eye_from_world.ok());
  return eye_from_world->inverse();
}

/// A runtime that differs from the usual one.
inline RuntimeTraits with(const std::function<void(RuntimeTraits&)>& change) {
  RuntimeTraits traits;
  change(traits);
  return traits;
}

}  // namespace orthonav::test::presenting_test
