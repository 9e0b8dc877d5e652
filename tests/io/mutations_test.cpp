// Every reader against damaged files: it refuses them or returns a sound mesh, and never crashes.

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "tests/fuzz/check_reader.h"
#include "tests/fuzz/samples.h"
#include "tests/support/sanitized.h"

namespace dmoscope::testing {
namespace {

constexpr int kMutantsPerFormat = 1000;  // besides those of each sample:
constexpr int kMutantsPerSample = 200;
constexpr std::size_t kMostCuts = kSanitized ? 1000 : 5000;  // cuts per sample

/// Changes the bytes: one to three are flipped, inserted, deleted, or replaced by characters that upset parsers most.
std::string mutated(std::string bytes, std::mt19937_64& random) {
  constexpr std::string_view kNasty = "0123456789-+.eEnN \n\r\t#\0\xff\x7f";
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  for (std::size_t edits = 1 + below(3); edits > 0 && !bytes.empty(); --edits) {
    const std::size_t at = below(bytes.size());
    switch (below(5)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes[at] = kNasty[below(kNasty.size())];
        break;
      case 2:
        bytes.insert(at, 1, kNasty[below(kNasty.size())]);
        break;
      case 3:
        bytes.erase(at, 1 + below(4));
        break;
      default:
        bytes.insert(at, bytes.substr(below(bytes.size()), below(12)));
        break;
    }
  }
  return bytes;
}

TEST(Mutations, EveryFormatHasASample) {
  std::set<std::string> formats;
  for (const Sample& sample : samples()) formats.insert(sample.format);
  for (const FormatInfo& format : format_table())  // all but the one of several files, see pvtu_test.cpp
    EXPECT_TRUE(format.name == "pvtu" || formats.contains(std::string(format.name))) << format.name;
}

TEST(Mutations, SamplesAreValid) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.format + " " + sample.name);
    EXPECT_NO_THROW(read_bytes(sample.format, sample.bytes));
    EXPECT_TRUE(check_reader(sample.format, sample.bytes));
  }
}

TEST(Mutations, TruncatedAnywhereIsRefusedOrSound) {
  for (const Sample& sample : samples()) {
    const std::size_t step = 1 + sample.bytes.size() / kMostCuts;
    for (std::size_t size = 0; size < sample.bytes.size(); size += step) {
      SCOPED_TRACE(sample.format + " " + sample.name + " cut to " + std::to_string(size));
      ASSERT_NO_THROW(check_reader(sample.format, sample.bytes.substr(0, size)));
    }
  }
}

TEST(Mutations, DamagedIsRefusedOrSound) {
  std::map<std::string, int> samples_of;
  for (const Sample& sample : samples()) ++samples_of[sample.format];
  for (const Sample& sample : samples()) {
    if (kSanitized && sample.bytes.starts_with("\x89HDF")) continue;  // HDF5's library leaks memory if a file's structure is damaged
    std::mt19937_64 random(20181018);
    int read = 0;
    const int mutants = std::max(kMutantsPerSample, kMutantsPerFormat / samples_of[sample.format] + 1);
    for (int i = 0; i < mutants; ++i) {
      const std::string bytes = mutated(sample.bytes, random);
      try {
        read += check_reader(sample.format, bytes) ? 1 : 0;
      } catch (const std::exception& error) {
        FAIL() << sample.format << " " << sample.name << " mutant " << i << ": " << error.what() << "\n" << bytes;
      }
    }
    EXPECT_GT(read, 0) << sample.format << " " << sample.name << ": no mutant was valid, so nothing but refusing was tested";
    EXPECT_LT(read, mutants) << sample.format << " " << sample.name;
  }
}

}  // namespace
}  // namespace dmoscope::testing
