#include "core/view/drawing_path.h"

#include <gtest/gtest.h>

namespace dmoscope {
namespace {

TEST(DrawingPath, IsTheFastestThereIsWithTheReasonAgainstAFasterOne) {
  EXPECT_EQ(drawing_path(Backend::Cuda, "NVIDIA H200", "").sentence(), "cuda with interop");
  EXPECT_EQ(drawing_path(Backend::Cuda, "NVIDIA H200", "OpenGL is drawn by llvmpipe").sentence(),
            "cuda with host copy: no interop: OpenGL is drawn by llvmpipe");
  EXPECT_EQ(drawing_path(Backend::Cpu, "no cuda: no driver", "").sentence(), "cpu: no cuda: no driver");
  EXPECT_EQ(drawing_path(Backend::Cpu, "no cuda: no driver", "OpenGL is drawn by llvmpipe").sentence(), "cpu: no cuda: no driver");
  EXPECT_EQ(drawing_path(Backend::Cpu, "", "").sentence(), "cpu") << "nothing else was wanted";
}

}  // namespace
}  // namespace dmoscope
