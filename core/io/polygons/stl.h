#pragma once
// The facets of an STL file, ASCII or binary, one after the other. Format: 3D Systems, StereoLithography Interface Specification, 1989.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

#include "core/base/progress.h"
#include "core/io/reading/source_file.h"

namespace dmoscope {

inline constexpr std::size_t kStlHeaderBytes = 84;  // 80 bytes of any text and the number of facets
inline constexpr std::size_t kStlFacetBytes = 50;   // normal and three corners in float32, attribute in uint16

struct StlFacet {
  /// Coordinates x y z of the normal, then of the three corners.
  std::array<double, 12> numbers{};
  /// Offset of each number in the file, and its number of bytes.
  std::array<std::size_t, 12> places{};
  std::array<std::size_t, 12> sizes{};
  std::uint16_t attribute = 0;  // binary files only
};

/// Whether it is a binary file: its size agrees with its number of facets, or it cannot be text. ("solid" may begin both kinds.)
[[nodiscard]] bool is_binary_stl(std::string_view bytes) noexcept;
/// Whether the bytes are certainly an STL file.
[[nodiscard]] bool recognises_stl(std::string_view bytes);

/// Calls `facet` for each facet and `solid` for each solid's name (for a binary file: its header's text). Corners are finite. Throws
/// InputError, Cancelled.
void for_each_stl_facet(const SourceFile& source, Progress& progress, const std::function<void(std::string_view name)>& solid,
                        const std::function<void(const StlFacet& facet)>& facet);

}  // namespace dmoscope
