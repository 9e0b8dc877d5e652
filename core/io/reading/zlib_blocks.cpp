#include "core/io/reading/zlib_blocks.h"

#include <new>

#include <zlib.h>

namespace dmoscope {

bool zlib_unpack(std::string_view packed, std::size_t size, std::vector<char>& out) {
  constexpr std::size_t kMostPerByte = 1032;  // best ratio of deflate
  if (size / kMostPerByte > packed.size()) return false;
  const std::size_t before = out.size();
  out.resize(before + size);
  uLongf unpacked = size;
  auto packed_size = static_cast<uLong>(packed.size());
  const int result =
      uncompress2(reinterpret_cast<Bytef*>(out.data() + before), &unpacked, reinterpret_cast<const Bytef*>(packed.data()), &packed_size);
  if (result == Z_OK && unpacked == size && packed_size == packed.size()) return true;
  out.resize(before);
  if (result == Z_MEM_ERROR) throw std::bad_alloc();
  return false;
}

std::string zlib_packed(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  const int result = compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                               static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION);
  if (result != Z_OK) throw std::bad_alloc();  // the only remaining reason, given the bound
  packed.resize(size);
  return packed;
}

}  // namespace dmoscope
