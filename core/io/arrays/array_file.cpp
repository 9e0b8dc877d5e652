#include "core/io/arrays/array_file.h"

#include <fmt/format.h>

#include "core/base/error.h"
#ifdef DMOSCOPE_HDF5
#include "core/io/arrays/hdf5_file.h"
#endif

namespace dmoscope {

void ArrayFile::fail(const std::string& what) const { throw InputError(file_, 0, what); }

void ArrayFile::take_room(std::uint64_t count, std::size_t) {
  if (count > bytes_.size()) fail(fmt::format("truncated: {} things are more than it has bytes", count));
}

bool is_hdf5(std::string_view bytes) noexcept { return bytes.starts_with("\x89HDF\r\n\x1a\n"); }

#ifdef DMOSCOPE_HDF5
std::unique_ptr<ArrayFile> open_hdf5(const SourceFile& source, const IoContext& context) {
  const std::string file = source.path().string();
  if (!is_hdf5(source.bytes())) throw InputError(file, 0, "this is no HDF5 file");
  return std::make_unique<Hdf5File>(source.bytes(), file, context);
}
#else
std::unique_ptr<ArrayFile> open_hdf5(const SourceFile& source, const IoContext&) {
  throw InputError(source.path().string(), 0,
                   is_hdf5(source.bytes())
                       ? "this is an HDF5 file (netCDF-4 files are such), and this build of the program was made without "
                         "HDF5: convert the mesh with ParaView or meshio to .vtu, or a netCDF-4 file with nccopy -k cdf5"
                       : "this is no HDF5 file");
}
#endif

}  // namespace dmoscope
