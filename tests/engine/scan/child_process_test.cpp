#include "engine/scan/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <new>
#include <vector>

#include "base/sanitizers.h"
#include "base/write_all.h"
#include "engine/scan/volume_bytes.h"

namespace orthonav::engine::child_process_test {
namespace {

using ::testing::HasSubstr;

constexpr ChildLimits kLimits{std::chrono::seconds(1), 1U << 28U};

std::string refusal(const std::function<bool(int)>& work) {
  const auto bytes = bytes_from_child(kLimits, work);
  return bytes ? "no refusal" : bytes.error().message;
}

TEST(ChildProcess, HandsBackWhatItWrote) {
  const std::string much(3'000'000, 'x');
  const auto bytes =
      bytes_from_child(kLimits, [&](int file) { return write_all(file, much) == 0; });
  ASSERT_TRUE(bytes.ok()) << bytes.error().message;
  EXPECT_EQ(bytes->view(), much);
  const auto nothing = bytes_from_child(kLimits, [](int) { return true; });
  ASSERT_TRUE(nothing.ok());
  EXPECT_TRUE(nothing->view().empty());
}

TEST(ChildProcess, EndsAloneAndSilently) {
  ::testing::internal::CaptureStderr();
  EXPECT_THAT(refusal([](int) -> bool { std::abort(); }), HasSubstr("its reader crashed"));
  EXPECT_THAT(refusal([](int) -> bool { return std::raise(SIGSEGV) == 0; }),
              HasSubstr("its reader crashed"));
  EXPECT_THAT(refusal([](int) -> bool { return std::raise(SIGKILL) == 0; }),
              HasSubstr("its reader was killed"));
  EXPECT_THAT(refusal([](int) -> bool {
                for (std::atomic<int> i = 0;; ++i) {
                }
              }),
              HasSubstr("its reader found no end in 1 s"));
  EXPECT_THAT(refusal([](int) -> bool { return std::raise(SIGTERM) == 0; }),
              HasSubstr("was stopped"));
  EXPECT_THAT(refusal([](int) -> bool { throw std::bad_alloc(); }), HasSubstr("gave up"));
  EXPECT_THAT(refusal([](int) { return false; }), HasSubstr("gave up"));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(ChildProcess, TakesNoMoreMemoryThanItMay) {
  if (sanitized()) {
    GTEST_SKIP() << "sanitizers map more than they use";
  }
  EXPECT_THAT(refusal([](int) { return std::vector<char>(1U << 30U).size() > 1; }),
              HasSubstr("gave up"));
}

TEST(VolumeBytes, ArriveAsTheyWereSent) {
  Volume sent;
  sent.grid.size = {2, 1, 3};
  sent.grid.origin_m = {0.1, -0.2, 0.3};
  sent.layers = 2;
  sent.values = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, -1000};
  sent.fields = {{"Segment0_Name", "L4"}, {"empty", ""}};
  const auto bytes = bytes_from_child(kLimits, [&](int file) { return write_volume(file, sent); });
  ASSERT_TRUE(bytes.ok());
  const auto got = volume_of(bytes->view());
  ASSERT_TRUE(got.ok()) << got.error().message;
  EXPECT_EQ(got->grid.size, sent.grid.size);
  EXPECT_EQ(got->grid.origin_m, sent.grid.origin_m);
  EXPECT_EQ(got->layers, 2u);
  EXPECT_EQ(got->values, sent.values);
  EXPECT_EQ(got->fields, sent.fields);
  EXPECT_FALSE(volume_of(bytes->view().substr(0, bytes->view().size() - 1)).ok());
  EXPECT_FALSE(volume_of({}).ok());
}

TEST(VolumeBytes, CarryTheReasonOfARefusal) {
  const auto bytes = bytes_from_child(kLimits, [](int file) {
    return write_volume(file, Error{"none.nii: no such file", ErrorCode::kNotFound});
  });
  ASSERT_TRUE(bytes.ok());
  const auto got = volume_of(bytes->view());
  ASSERT_FALSE(got.ok());
  EXPECT_EQ(got.error().message, "none.nii: no such file");
  EXPECT_EQ(got.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace orthonav::engine::child_process_test
