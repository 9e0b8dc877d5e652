#include "app/drawing_path.h"

#include <gtest/gtest.h>

#include "tests/support/fake_accelerator.h"

namespace dmoscope::app {
namespace {

TEST(DrawingPath, IsTheFastestThereIsWithTheReasonAgainstAFasterOne) {
  const auto is = [](const DrawingPath& path, const char* name, const char* reason) { return path.name == name && path.reason == reason; };
  const Acceleration cuda = testing::acceleration(std::make_shared<testing::FakeDevice>());
  const Acceleration none{nullptr, "no NVIDIA driver is installed"};
  EXPECT_TRUE(is(drawing_path(cuda, ""), "cuda with interop", ""));
  EXPECT_TRUE(is(drawing_path(cuda, "OpenGL is drawn by llvmpipe"), "cuda with host copy", "no interop: OpenGL is drawn by llvmpipe"));
  EXPECT_TRUE(is(drawing_path(none, ""), "cpu", "no cuda: no NVIDIA driver is installed"));
  EXPECT_TRUE(is(drawing_path(none, "OpenGL is drawn by llvmpipe"), "cpu", "no cuda: no NVIDIA driver is installed"));
}

}  // namespace
}  // namespace dmoscope::app
