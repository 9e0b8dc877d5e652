#pragma once
// Declarations that the tests share are in dmoscope::testing, whose name hides GoogleTest's own: within dmoscope, testing:: means both.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dmoscope::testing {
using namespace ::testing;  // NOLINT(google-build-using-namespace): the one place that joins them
}
