// Tests that all ranks of an MPI job run together, each the same tests in the same order. Only the first rank reports progress; other ranks
// report their failures themselves.

#include <gtest/gtest.h>

#include "mpi/world/world.h"

namespace {

/// Listener that prints failures alone.
class Quiet : public testing::EmptyTestEventListener {
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (result.failed())
      printf("%s:%d: %s\n", result.file_name() != nullptr ? result.file_name() : "?", result.line_number(), result.message());
  }
};

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const dmoscope::MpiSession session(argc, argv);
  const dmoscope::World world;
  if (!world.is_first()) {
    testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new Quiet);
  }
  return world.any(RUN_ALL_TESTS() != 0) ? 1 : 0;
}
