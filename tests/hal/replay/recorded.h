#pragma once

#include <filesystem>
#include <memory>
#include <utility>

#include "hal/replay/recorder.h"
#include "tests/support/recorded_session.h"
#include "tests/support/scripted_session.h"

namespace orthonav::replay::recorder_test {

inline std::unique_ptr<fake::FakeHeadset> headset(
    fake::Script script = orthonav::test::scripted_session()) {
  return std::make_unique<fake::FakeHeadset>(std::move(script));
}

/// What came while all of it was recorded.
inline orthonav::test::SessionLog record(std::unique_ptr<Headset> inner,
                                         const std::filesystem::path& folder,
                                         const RecorderOptions& options = {}) {
  return orthonav::test::play_to_the_end(
      RecordingHeadset::create(std::move(inner), folder, options));
}

}  // namespace orthonav::replay::recorder_test
