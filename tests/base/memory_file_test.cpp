#include "base/memory_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace orthonav::memory_file_test {
namespace {

TEST(MemoryFile, HoldsItsContentAtAPath) {
  const auto file = MemoryFile::create("some bytes");
  ASSERT_TRUE(file.ok());
  std::ifstream in(file->path());
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "some bytes");
}

}  // namespace
}  // namespace orthonav::memory_file_test
