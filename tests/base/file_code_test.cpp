#include "base/file_code.h"

#include <gtest/gtest.h>

namespace orthonav {
namespace {

TEST(FileCode, TellsWhatIsNotThereFromWhatIsRefused) {
  EXPECT_EQ(file_code(ENOENT), ErrorCode::kNotFound);
  EXPECT_EQ(file_code(ENOSPC), ErrorCode::kIo);
  EXPECT_EQ(file_code(EACCES), ErrorCode::kIo);
  EXPECT_EQ(file_code(std::make_error_code(std::errc::no_such_file_or_directory)),
            ErrorCode::kNotFound);
  EXPECT_EQ(file_code(std::make_error_code(std::errc::read_only_file_system)), ErrorCode::kIo);
}

TEST(FileCode, LooksForAFileThatCouldNotBeOpened) {
  EXPECT_EQ(code_of_unopened("/no/such/file"), ErrorCode::kNotFound);
  EXPECT_EQ(code_of_unopened("/proc/self"), ErrorCode::kIo) << "it is there";
}

}  // namespace
}  // namespace orthonav
