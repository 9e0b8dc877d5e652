// The reader of the format that the environment names (DMOSCOPE_FUZZ_FORMAT) against the inputs of libFuzzer.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "tests/fuzz/check_reader.h"

namespace {
std::string format;
}

extern "C" int LLVMFuzzerInitialize(int* /*count*/, char*** /*arguments*/) {
  const char* name = std::getenv("DMOSCOPE_FUZZ_FORMAT");
  if (name == nullptr) {
    std::fprintf(stderr, "DMOSCOPE_FUZZ_FORMAT names no format\n");
    std::exit(1);
  }
  format = name;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    dmoscope::testing::check_reader(format, std::string(reinterpret_cast<const char*>(data), size));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::abort();
  }
  return 0;
}
