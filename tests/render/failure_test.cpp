#include "render/vulkan/failure.h"

#include <gtest/gtest.h>

#include <new>

namespace orthonav::render {
namespace {

/// How a renderer's public call handles exceptions thrown beneath it.
template <class Thrown>
Error caught(const Thrown& thrown) {
  try {
    throw thrown;
  } catch (const std::exception&) {
    return error_in_flight();
  }
}

TEST(Failure, KeepsMessageAndCodeOfTheErrorThatItCarries) {
  const Error error = caught(Failure(Error{"scene: 3 views, limit 2", ErrorCode::kNotFound}));
  EXPECT_EQ(error.message, "scene: 3 views, limit 2");
  EXPECT_EQ(error.code, ErrorCode::kNotFound);
}

TEST(Failure, TellsALostDeviceFromOneThatRanOutOfMemory) {
  const Error lost = caught(Failure(VK_ERROR_DEVICE_LOST, "drawing"));
  EXPECT_EQ(lost.message, "renderer: drawing: device lost");
  EXPECT_EQ(lost.code, ErrorCode::kLost);
  const Error full = caught(Failure(VK_ERROR_OUT_OF_DEVICE_MEMORY, "buffer"));
  EXPECT_EQ(full.message, "renderer: buffer: out of device memory");
  EXPECT_EQ(full.code, ErrorCode::kUnavailable);
}

TEST(Failure, IsOneLineWhateverWasThrown) {
  EXPECT_EQ(caught(std::bad_alloc()).message, "renderer: out of host memory");
  EXPECT_EQ(caught(std::length_error("vector")).message, "renderer: vector");
  EXPECT_EQ(caught(std::runtime_error("renderer: no")).message, "renderer: no");
}

}  // namespace
}  // namespace orthonav::render
