#pragma once

#include <memory>

#include "hal/replay/recorder.h"
#include "tests/support/session_log.h"

namespace orthonav::test {

/// Plays a headset through a recorder and finishes the recording.
inline SessionLog play_to_the_end(Result<std::unique_ptr<replay::RecordingHeadset>> recorder) {
  EXPECT_TRUE(recorder.ok()) << recorder.error().message;
  if (!recorder) {
    return {};
  }
  SessionLog log = play(**recorder);
  const Status closed = (*recorder)->close();
  EXPECT_TRUE(closed.ok()) << closed.error().message;
  return log;
}

}  // namespace orthonav::test
