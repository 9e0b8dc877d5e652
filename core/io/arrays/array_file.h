#pragma once
// Files that are a set of named arrays: netCDF and HDF5, on which Exodus II, CGNS and XDMF are built.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/reading/binary_scalar.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"

namespace dmoscope {

/// What an array is.
struct ArrayInfo {
  bool text = false;                      // characters; `type` means nothing then
  ScalarType type = ScalarType::Float64;  // of its numbers
  std::vector<std::uint64_t> sizes;       // the slowest first; none: one number alone
  [[nodiscard]] std::uint64_t count() const noexcept {
    std::uint64_t product = 1;  // the files' readers have checked that it does not overflow
    for (const std::uint64_t size : sizes) product *= size;
    return product;
  }
};

/// New numbers for an array, all of them.
struct ArrayValues {
  std::string name;
  std::vector<double> values;
};

/// Every function throws InputError, naming the file and the array, for what is damaged, of another type, or too large for the memory.
class ArrayFile {
 public:
  ArrayFile(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}
  virtual ~ArrayFile() = default;
  ArrayFile(const ArrayFile&) = delete;
  ArrayFile& operator=(const ArrayFile&) = delete;

  /// Nothing where there is no such array.
  [[nodiscard]] virtual std::optional<ArrayInfo> find(const std::string& name) = 0;
  /// The numbers of an array, or of that part of it that has these first indices (of its slowest sizes).
  [[nodiscard]] virtual std::vector<double> numbers(const std::string& name, std::span<const std::uint64_t> first = {}) = 0;
  /// The same of an array of whole numbers.
  [[nodiscard]] virtual std::vector<std::int64_t> wholes(const std::string& name) = 0;
  /// All characters of an array of such.
  [[nodiscard]] virtual std::string text(const std::string& name) = 0;
  /// A text that belongs to an array; empty where there is none.
  [[nodiscard]] virtual std::string attribute(const std::string& array, const std::string& name) = 0;
  /// The length of a dimension that has a name (netCDF).
  [[nodiscard]] virtual std::optional<std::uint64_t> dimension(const std::string& name) = 0;
  /// The whole file with other numbers in these arrays, each rounded to what its array holds; all else as it was. `progress` is checked.
  [[nodiscard]] virtual std::string replaced(std::span<const ArrayValues> arrays) = 0;

  /// Call it before memory is taken for what the file only says that it has. Throws InputError where that is more than a file of its size
  /// should become.
  virtual void take_room(std::uint64_t count, std::size_t bytes_each);

  [[noreturn]] void fail(const std::string& what) const;

 protected:
  [[nodiscard]] std::string_view bytes() const noexcept { return bytes_; }
  [[nodiscard]] const std::string& file() const noexcept { return file_; }

 private:
  std::string_view bytes_;
  std::string file_;
};

/// Opens a netCDF file of any kind; `source` must outlive it. netCDF-4 files are HDF5 files, which not every build of the program reads.
/// Throws InputError.
[[nodiscard]] std::unique_ptr<ArrayFile> open_netcdf(const SourceFile& source, const IoContext& context);

/// Opens an HDF5 file; `source` must outlive it. Throws InputError, also where the program was built without HDF5.
[[nodiscard]] std::unique_ptr<ArrayFile> open_hdf5(const SourceFile& source, const IoContext& context);

/// Do the bytes begin a classic netCDF file (versions 1, 2, 5)?
[[nodiscard]] bool is_netcdf_classic(std::string_view bytes) noexcept;
/// Do the bytes begin an HDF5 file?
[[nodiscard]] bool is_hdf5(std::string_view bytes) noexcept;

}  // namespace dmoscope
