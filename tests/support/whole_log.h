#pragma once

#include <gtest/gtest.h>

#include <string>

#include "engine/io/posix_env.h"
#include "tests/support/logged_operation.h"
#include "tests/support/scripted_surgeon.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::test {

/// The bytes of the log of a whole operation on two levels, from its first word to its end.
inline std::string whole_log() {
  const TemporaryFolder folder;
  engine::PosixEnv env;
  ScriptedOperation s({"L4", "L5"}, three_places(), engine::Verification::kByTouch);
  s.registers_within(0.0003);
  const auto log =
      engine::OperationLog::begin(env, folder.path().string(), identity_of(s), s.session().levels(),
                                  engine::RecordWriter::Waits::kUntilDurable,
                                  engine::RecordLog::Earlier::kKept)
          .value();
  s.session().observe(log.get());
  ScriptedSurgeon(s, 5, Story::kEventful).finish();
  EXPECT_TRUE(log->finish(true, "").ok());
  return content_of(folder.file("operation.resume"));
}

}  // namespace orthonav::test
