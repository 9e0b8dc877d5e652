// Ways to OpenGL without a window.
#include <cstdlib>

#include <gmock/gmock.h>

#include "fixture.h"
#include "render/egl_order.h"
#include "tests/support/picture_difference.h"

namespace dmoscope::render {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> order(const std::vector<EglDevice>& devices, std::string_view forced = {}, std::optional<int> cuda = {}) {
  std::vector<std::string> names;
  for (const EglWay& way : egl_order(devices, forced, cuda)) names.push_back(way.description);
  return names;
}

const std::vector<EglDevice> kTwoCards{{.cuda = 1}, {.cuda = 0}, {.software = true}};

TEST(EglOrder, MesaComesFirstWhereNothingElseIsKnown) {
  EXPECT_THAT(order({}), ElementsAre("surfaceless EGL"));
  EXPECT_THAT(order({{.software = true}}), ElementsAre("surfaceless EGL", "EGL device 0 (software)"));
  EXPECT_THAT(order({{}, {}}, {}, 0), ElementsAre("surfaceless EGL", "EGL device 0", "EGL device 1")) << "no device is CUDA's";
}

TEST(EglOrder, TheDeviceThatSmoothsDrawsToo) {
  EXPECT_THAT(order(kTwoCards, {}, 0),
              ElementsAre("EGL device 1 (CUDA device 0)", "surfaceless EGL", "EGL device 0 (CUDA device 1)", "EGL device 2 (software)"));
  EXPECT_THAT(order(kTwoCards, {}, 1),
              ElementsAre("EGL device 0 (CUDA device 1)", "surfaceless EGL", "EGL device 1 (CUDA device 0)", "EGL device 2 (software)"));
}

TEST(EglOrder, OneWayCanBeForced) {
  EXPECT_THAT(order(kTwoCards, "surfaceless", 0), ElementsAre("surfaceless EGL"));
  EXPECT_THAT(order(kTwoCards, "device:2", 0), ElementsAre("EGL device 2 (software)"));
  EXPECT_THAT(order(kTwoCards, "cuda:1", 0), ElementsAre("EGL device 0 (CUDA device 1)"));
  EXPECT_EQ(egl_order(kTwoCards, "cuda:1", 0)[0].device, std::optional<std::size_t>(0));
  for (const char* wrong : {"device:3", "cuda:2", "device:", "device:-1", "device:1x", "gpu"}) {
    try {
      (void)egl_order(kTwoCards, wrong, 0);
      ADD_FAILURE() << wrong;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), HasSubstr("surfaceless, device:0, cuda:1, device:1, cuda:0, device:2"));
      EXPECT_THAT(error.what(), HasSubstr(wrong));
    }
  }
}

/// A context by a forced way; none if EGL lacks it.
std::unique_ptr<Context> forced_context(const char* way) {
  ::setenv("DMOSCOPE_EGL", way, 1);
  std::unique_ptr<Context> context;
  try {
    context = create_headless_context();
  } catch (const Error&) {
  }
  ::unsetenv("DMOSCOPE_EGL");
  return context;
}

TEST(Headless, TheDevicePlatformDrawsWhatSurfacelessDraws) {
  std::vector<Image> pictures;
  for (const char* way : {"device:0", "surfaceless"}) {
    const std::unique_ptr<Context> context = forced_context(way);
    if (!context) GTEST_SKIP() << "EGL here has no " << way;
    EXPECT_THAT(context->description(), HasSubstr(way[0] == 'd' ? "EGL device 0" : "surfaceless EGL"));
    Framebuffer target(static_cast<int>(kWidth), static_cast<int>(kHeight));
    PlanarScene scene;
    const Mesh mesh = triangle_and_quadrilateral();
    scene.set_mesh(mesh, Plane{});
    scene.update(mesh.positions, std::vector<float>{0.25F, 0.8F}, {});
    scene.draw(target, unit_camera(), Style::dark(), {}, 1.0);
    pictures.push_back(target.read_pixels());
  }
  EXPECT_TRUE(compare(pictures[0], pictures[1]).alike());
  EXPECT_TRUE(near_colour(pictures[0].at(60, 60), sample(ColourMap::Viridis, 0.25), 40));
}

TEST(Headless, AWayThatIsNotThereIsAnError) {
  if (!forced_context("surfaceless")) GTEST_SKIP() << "no EGL here";
  ::setenv("DMOSCOPE_EGL", "cuda:99", 1);
  EXPECT_THROW((void)create_headless_context(), UsageError);
  ::unsetenv("DMOSCOPE_EGL");
}

}  // namespace
}  // namespace dmoscope::render
