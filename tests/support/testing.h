#pragma once
// What the tests share lies in dmoscope::testing, whose name hides GoogleTest's own: within dmoscope, testing:: means both.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dmoscope::testing {
using namespace ::testing;  // NOLINT(google-build-using-namespace): the one place that joins them
}
