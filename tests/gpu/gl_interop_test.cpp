// Sharing buffers with OpenGL, as far as it can be tried without a context. The rest is in tests/gui/device_drawing_test.cpp.

#include "gpu/gl_interop.h"

#include <gtest/gtest.h>

namespace dmoscope::gpu {
namespace {

TEST(GlInterop, SaysWhatIsInTheWayWhereNoContextIsCurrent) {
  EXPECT_NE(gl_obstacle(0), "");
  EXPECT_EQ(gl_obstacle(0), gl_obstacle(0)) << "asking leaves nothing behind";
}

}  // namespace
}  // namespace dmoscope::gpu
