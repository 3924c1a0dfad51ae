#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/io/record_log.h"
#include "tests/support/is_ok.h"
#include "tests/support/memory_env.h"

namespace orthonav::test {

inline const std::string kToldLog = "out/operation.resume";

/// Records with lengths both below and above a block's.
inline std::vector<std::string> long_story() {
  std::vector<std::string> payloads = {"begin", "", "a"};
  for (std::size_t i = 0; i < 36; ++i) {
    const std::size_t size = i % 3 == 0 ? 480 + i : (i * i * 37) % 3000;
    payloads.push_back(std::string(size, static_cast<char>('b' + i % 20)));
  }
  return payloads;
}

/// Writes them; returns after how many calls each record was reported durable.
inline std::vector<std::size_t> tell(
    MemoryEnv& env, const std::vector<std::string>& payloads,
    engine::RecordLog::Earlier earlier = engine::RecordLog::Earlier::kKept) {
  std::vector<std::size_t> durable_after;
  auto log = engine::RecordLog::create(env, kToldLog, {1, 1, payloads.front()}, earlier);
  for (std::size_t i = 0; log && i < payloads.size(); ++i) {
    if (i > 0 && !(*log)->append({2, 1, payloads[i]})) {
      break;
    }
    durable_after.push_back(env.calls().size());
  }
  return durable_after;
}

/// How many records had been reported durable after this many calls.
inline std::size_t durable_by(const std::vector<std::size_t>& durable_after, std::size_t calls) {
  return static_cast<std::size_t>(std::count_if(durable_after.begin(), durable_after.end(),
                                                [&](std::size_t after) { return after <= calls; }));
}

/// How many records the newest log holds; each must be as it was written.
inline std::size_t records_left(const Files& files, const std::vector<std::string>& payloads) {
  MemoryEnv env(files);
  const auto path = engine::newest_log(env, kToldLog);
  if (!path || !*path) {
    return 0;
  }
  const auto read = engine::read_log(env, **path);
  EXPECT_TRUE(is_ok(read));
  if (!read) {
    return 0;
  }
  EXPECT_GE(read->records.size(), 1u) << "a log has its name before it has its first record";
  EXPECT_LE(read->records.size(), payloads.size());
  for (std::size_t i = 0; i < std::min(read->records.size(), payloads.size()); ++i) {
    EXPECT_EQ(read->records[i].payload, payloads[i]);
  }
  return read->records.size();
}

}  // namespace orthonav::test
