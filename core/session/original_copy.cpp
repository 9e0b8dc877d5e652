#include "core/session/original_copy.h"

#include <algorithm>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope {

namespace fs = std::filesystem;

fs::path original_name(const fs::path& file, unsigned number) {
  const std::string tag = number == 1 ? ".orig" : fmt::format(".orig{}", number);
  fs::path stem = file.stem(), ending = file.extension();
  if (ending == ".gz") {  // file name like "a.vtk.gz"
    ending = stem.extension().string() + ending.string();
    stem = stem.stem();
  }
  return file.parent_path() / (stem.string() + tag + ending.string());
}

std::vector<fs::path> keep_originals(std::span<const fs::path> files) {
  std::error_code error;
  const auto taken = [&](unsigned number) {
    return std::ranges::any_of(files,
                               [&](const fs::path& file) { return fs::exists(fs::symlink_status(original_name(file, number), error)); });
  };
  unsigned number = 1;
  while (taken(number)) ++number;
  std::vector<fs::path> copies;
  for (const fs::path& file : files) {
    copies.emplace_back();
    if (!fs::exists(file, error)) continue;
    const fs::path copy = original_name(file, number);
    if (fs::copy_file(file, copy, fs::copy_options::none, error)) {
      copies.back() = copy;
      continue;
    }
    std::error_code ignored;
    if (error != std::errc::file_exists) fs::remove(copy, ignored);  // removes the incomplete copy
    for (const fs::path& other : copies) fs::remove(other, ignored);
    throw OutputError(copy.string(), fmt::format("no copy can be kept of what is written over: {}", error.message()));
  }
  return copies;
}

}  // namespace dmoscope
