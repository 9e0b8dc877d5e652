#pragma once
// Numbers of a VTU file's arrays, in any encoding.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/io/reading/unpack_budget.h"
#include "core/io/vtu/vtu_document.h"

namespace dmoscope {

/// The bytes of an array that is not ASCII, in the file's byte order.
struct VtuData {
  std::vector<char> owned;  // decoded bytes; `bytes` points here, or into the file
  std::string_view bytes;
  std::size_t end = 0;    // end in the file, with header and padding
  std::size_t block = 0;  // bytes in a block, 0 if it is not compressed
};

/// Separators of the numbers of an ASCII array: the next tag ends them.
[[nodiscard]] TextSyntax vtu_text_syntax();

/// The bytes of an array that is not ASCII. Throws InputError unless there are `expected` of them.
[[nodiscard]] VtuData vtu_data(const VtuDocument& document, const VtuArray& array, std::size_t expected);

/// The numbers of an array, which may be infinite or NaN. Throws InputError unless there are `expected` of them. `places`: gets the offset
/// of each in the file, if the array is ASCII. `end`: gets the array's end in the file, if it is not ASCII. `budget`: pays for the numbers
/// of arrays that are not ASCII.
[[nodiscard]] std::vector<double> vtu_numbers(const VtuDocument& document, const VtuArray& array, std::size_t expected, std::size_t& end,
                                              UnpackBudget& budget, std::vector<std::uint64_t>* places = nullptr);
/// The numbers of an array as whole numbers; those beyond 63 bits are -1. See vtu_numbers().
[[nodiscard]] std::vector<std::int64_t> vtu_wholes(const VtuDocument& document, const VtuArray& array, std::size_t expected,
                                                   std::size_t& end, UnpackBudget& budget);

/// Encoding of arrays that are not ASCII.
struct VtuEncoding {
  bool big_endian = false;
  ScalarType header = ScalarType::UInt64;  // type of the sizes before an array: UInt32 or UInt64
  bool zlib = true;
  bool base64 = false;
  std::size_t block = 32768;  // bytes in a block that is compressed separately
};

/// An array in the form of the file: its sizes and its bytes, which are in the encoding's byte order. Throws OutputError (through `file`)
/// if the sizes do not fit the header's type.
[[nodiscard]] std::string vtu_encoded(const std::string& file, std::string_view bytes, const VtuEncoding& encoding, ThreadPool* pool);

}  // namespace dmoscope
