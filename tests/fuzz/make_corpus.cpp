// Writes the samples of every format to FOLDER/<format>/: what the fuzzers start from.

#include <cstdio>
#include <exception>
#include <filesystem>

#include "core/io/writing/atomic_file.h"
#include "tests/fuzz/check_session.h"
#include "tests/fuzz/samples.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: make_corpus FOLDER\n", stderr);
    return 2;
  }
  try {
    std::vector<dmoscope::testing::Sample> samples = dmoscope::testing::samples();
    for (const bool joined : {false, true}) samples.push_back({joined ? "joined" : "named", "gzip", dmoscope::testing::gzip_off(joined)});
    samples.push_back({"saved", "session", dmoscope::testing::sample_session()});
    samples.push_back({"verbs", "script", std::string(dmoscope::testing::kSampleScript)});
    for (const dmoscope::testing::Sample& sample : samples) {
      if (sample.bytes.starts_with("\x89HDF")) continue;  // HDF5's library has faults of its own with damaged structure
      const auto folder = std::filesystem::path(argv[1]) / sample.format;
      std::filesystem::create_directories(folder);
      dmoscope::write_file_atomically(folder / sample.name, sample.bytes);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  return 0;
}
