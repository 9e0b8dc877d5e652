#pragma once
// Files that consist of named arrays: netCDF and HDF5, the base of Exodus II, CGNS and XDMF.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/reading/binary.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"

namespace dmoscope {

/// Type and sizes of an array.
struct ArrayInfo {
  bool text = false;                      // array of characters, for which `type` has no meaning
  ScalarType type = ScalarType::Float64;  // type of its numbers
  std::vector<std::uint64_t> sizes;       // sizes, the slowest first; empty: a single number
  [[nodiscard]] std::uint64_t count() const noexcept {
    std::uint64_t product = 1;  // does not overflow: the files' readers have checked that
    for (const std::uint64_t size : sizes) product *= size;
    return product;
  }
};

/// New numbers for all of an array.
struct ArrayValues {
  std::string name;
  std::vector<double> values;
};

/// A file of arrays. Every function throws InputError, naming the file and the array, for damaged data, data of another type, or too large
/// for the memory.
class ArrayFile {
 public:
  ArrayFile(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}
  virtual ~ArrayFile() = default;
  ArrayFile(const ArrayFile&) = delete;
  ArrayFile& operator=(const ArrayFile&) = delete;

  /// Type and sizes of an array; none if it does not exist.
  [[nodiscard]] virtual std::optional<ArrayInfo> find(const std::string& name) = 0;
  /// The numbers of an array, or of the part of it with these first indices (of its slowest sizes).
  [[nodiscard]] virtual std::vector<double> numbers(const std::string& name, std::span<const std::uint64_t> first = {}) = 0;
  /// The numbers of an array of whole numbers.
  [[nodiscard]] virtual std::vector<std::int64_t> wholes(const std::string& name) = 0;
  /// All characters of an array of text.
  [[nodiscard]] virtual std::string text(const std::string& name) = 0;
  /// A text attribute of an array; empty if there is none.
  [[nodiscard]] virtual std::string attribute(const std::string& array, const std::string& name) = 0;
  /// The length of a named dimension (netCDF).
  [[nodiscard]] virtual std::optional<std::uint64_t> dimension(const std::string& name) = 0;
  /// The whole file with other numbers in these arrays, each rounded to its array's type; all else is unchanged. `progress` is checked.
  [[nodiscard]] virtual std::string replaced(std::span<const ArrayValues> arrays) = 0;

  /// Accounts for memory of a size that only the file claims; to be called before taking it. Throws InputError if that is more than a file
  /// of its size should need.
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

/// Opens an HDF5 file; `source` must outlive it. Throws InputError, also if the program was built without HDF5.
[[nodiscard]] std::unique_ptr<ArrayFile> open_hdf5(const SourceFile& source, const IoContext& context);

/// Whether the bytes begin a classic netCDF file (versions 1, 2, 5).
[[nodiscard]] bool is_netcdf_classic(std::string_view bytes) noexcept;
/// Whether the bytes begin an HDF5 file.
[[nodiscard]] bool is_hdf5(std::string_view bytes) noexcept;

}  // namespace dmoscope
