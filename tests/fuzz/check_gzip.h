#pragma once
// Properties of any bytes as a file packed by gzip: they are refused with an InputError, or they unpack to no more than the given limit,
// which packs again, and unpacks to the same.

#include <string>

#include "core/base/error.h"
#include "core/io/reading/gzip.h"
#include "tests/fuzz/check_reader.h"

namespace dmoscope::testing {

/// Returns true if the bytes were unpacked, false if they were refused. Throws std::logic_error if a property is violated.
inline bool check_gzip(const std::string& bytes) {
  constexpr std::uint64_t kFine = 1U << 20U;
  Progress progress;
  FileBytes unpacked;
  try {
    unpacked = gunzipped("a.gz", bytes, {progress, nullptr, kFine});
  } catch (const InputError&) {
    return false;
  }
  require(unpacked.view().size() <= kFine, "more than was said to be fine");
  std::string packed;
  GzipPacker packer([&](std::string_view part) { packed += part; });
  packer.add(unpacked.view());
  packer.finish();
  require(is_gzip(packed), "what is packed must look like it");
  require(gunzipped("a.gz", packed, progress).view() == unpacked.view(), "the same bytes after packing");
  return true;
}

}  // namespace dmoscope::testing
