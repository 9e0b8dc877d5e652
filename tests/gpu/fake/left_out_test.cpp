#include <gtest/gtest.h>

namespace {
TEST(FakeCuda, NeedsAToolkit) { GTEST_SKIP() << "built without a CUDA toolkit: there are no kernels to run, and no calls of its runtime"; }
}  // namespace
