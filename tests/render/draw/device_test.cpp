#include "render/draw/device.h"

#include "render/draw/gl.h"

#include <gtest/gtest.h>
#include <thread>

namespace rend::device_test {
namespace {

TEST(Device, SpeaksOpenGl33Core) {
  const auto device = make_device();
  EXPECT_FALSE(device->renderer().empty());
  GLint major = 0, minor = 0, profile = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_GE(10 * major + minor, 33);
  EXPECT_TRUE(profile & GL_CONTEXT_CORE_PROFILE_BIT);
}

TEST(Device, MovesToAnotherThread) {
  const auto device = make_device();
  device->release();
  std::thread other([&] {
    device->make_current();
    EXPECT_NE(glGetString(GL_VERSION), nullptr);
    device->release();
  });
  other.join();
}

} // namespace
} // namespace rend::device_test
