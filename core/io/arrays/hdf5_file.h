#pragma once
// HDF5 files in memory: arrays and groups by their path ("/Base/Zone"). Needs HDF5's C library, which is not in every build.
//
// The library does not support several threads: only one file is open at a time in the whole program, others wait. Only the given bytes are
// read: links into other files, arrays kept in other files, and filters that would have to be loaded are refused.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/arrays/array_file.h"

namespace dmoscope {

class Hdf5File final : public ArrayFile {
 public:
  /// Opens a file in memory. `bytes` and the objects in `context` must outlive this. The unpacked size of arrays is bounded (see
  /// UnpackBudget). Throws InputError.
  Hdf5File(std::string_view bytes, std::string file, const IoContext& context);
  ~Hdf5File() override;

  std::optional<ArrayInfo> find(const std::string& name) override;
  std::vector<double> numbers(const std::string& name, std::span<const std::uint64_t> first = {}) override;
  std::vector<std::int64_t> wholes(const std::string& name) override;
  std::string text(const std::string& name) override;
  std::string attribute(const std::string& array, const std::string& name) override;
  std::optional<std::uint64_t> dimension(const std::string& name) override;
  std::string replaced(std::span<const ArrayValues> arrays) override;
  void take_room(std::uint64_t count, std::size_t bytes_each) override;

  /// A whole number that is an attribute of a group or an array; none if it has none of that name.
  [[nodiscard]] std::optional<std::int64_t> whole_attribute(const std::string& object, const std::string& name);
  /// Names of a group's members, in the order of their creation if the file records it, else sorted. Empty if there is no such group.
  [[nodiscard]] std::vector<std::string> children(const std::string& group);
  /// Whether the name leads to a group or an array. False for links into other files.
  [[nodiscard]] bool opens(const std::string& name) const;

 private:
  class Library;
  class Array;
  std::string replaced_by_library(std::string_view whole, std::span<const ArrayValues> arrays);

  std::unique_ptr<Library> library_;
  const IoContext& context_;
  std::uint64_t left_;  // bytes that may still be unpacked
};

}  // namespace dmoscope
