#pragma once
// Classic netCDF files: CDF-1, CDF-2 (offsets of 64 bits) and CDF-5 (counts of 64 bits).
// https://docs.unidata.ucar.edu/netcdf-c/current/file_format_specifications.html
//
// Parsed here rather than by netCDF's library: a header and unpacked arrays need little code, the library would bring along several more
// (libcurl among them), and damaged bytes meet only checks of this program.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/arrays/array_file.h"
#include "core/io/reading/binary.h"

namespace dmoscope {

class NetcdfClassic final : public ArrayFile {
 public:
  /// Reads the header; `bytes` must outlive this. Throws InputError.
  NetcdfClassic(std::string_view bytes, std::string file);

  std::optional<ArrayInfo> find(const std::string& name) override;
  std::vector<double> numbers(const std::string& name, std::span<const std::uint64_t> first = {}) override;
  std::vector<std::int64_t> wholes(const std::string& name) override;
  std::string text(const std::string& name) override;
  std::string attribute(const std::string& array, const std::string& name) override;
  std::optional<std::uint64_t> dimension(const std::string& name) override;
  std::string replaced(std::span<const ArrayValues> arrays) override;

 private:
  struct Variable {
    ArrayInfo info;
    bool of_records = false;  // its first size is the number of records, which are interleaved with those of other variables
    std::uint64_t begin = 0;
    std::uint64_t record_bytes = 0;  // bytes of one record of this variable, or of all of it
    std::map<std::string, std::string> attributes;
  };
  /// A contiguous range of values.
  struct Run {
    std::uint64_t offset, count;
  };

  class Header;
  const Variable& variable(const std::string& name) const;
  [[nodiscard]] std::vector<Run> runs(const Variable& variable, const std::string& name, std::span<const std::uint64_t> first) const;
  template <class Number, class Value>
  [[nodiscard]] std::vector<Number> load(const Variable& from, const std::string& name, std::span<const std::uint64_t> first, Value value);

  std::map<std::string, std::uint64_t> dimensions_;
  std::map<std::string, Variable> variables_;
  std::uint64_t records_ = 0;
  std::uint64_t record_stride_ = 0;  // bytes from one record to the next
};

}  // namespace dmoscope
