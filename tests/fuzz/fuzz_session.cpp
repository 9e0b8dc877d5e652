// Saved sessions, or scripts (DMOSCOPE_FUZZ_SCRIPT), against the inputs of libFuzzer.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "tests/fuzz/check_session.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
#ifdef DMOSCOPE_FUZZ_SCRIPT
    dmoscope::testing::check_script(bytes);
#else
    dmoscope::testing::check_session(bytes);
#endif
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::abort();
  }
  return 0;
}
