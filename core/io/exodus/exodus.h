#pragma once
// Exodus II files (.e .exo .g .ex2), which are netCDF files of any kind.
// https://sandialabs.github.io/seacas-docs/

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/io/array_patch.h"
#include "core/io/cell_table.h"
#include "core/io/format.h"

namespace dmoscope {

/// The words that groups of an Exodus file have as their role.
inline constexpr std::string_view kExodusBlock = "element block";
inline constexpr std::string_view kExodusNodeSet = "node set";
inline constexpr std::string_view kExodusSideSet = "side set";

/// The shape that a block's word for its elements ("HEX8", "tri") means with this number of nodes; nothing for what is not read: elements
/// of higher order, polyhedra.
[[nodiscard]] std::optional<CellShape> exodus_shape(std::string_view word, std::uint64_t nodes) noexcept;

/// A side of an element, from 1 as in the file, by the element's own corners from 0, outward; 2 to 4 of them. Empty where it has no such
/// side. `has_faces`: it is a shell whose first two sides are its front and its back, as they are in space.
[[nodiscard]] std::span<const Index> exodus_side(CellShape shape, bool has_faces, std::int64_t side) noexcept;
/// Does the word mean shells, which have faces among their sides?
[[nodiscard]] bool is_exodus_shell(std::string_view word) noexcept;

/// The coordinates of the file into `positions`, which gets its size. Throws InputError.
[[nodiscard]] CoordinateArrays read_exodus_points(ArrayFile& file, std::vector<Vec3>& positions);

/// See FormatHandler.
[[nodiscard]] Mesh read_exodus(SourceFile& source, const IoContext& context);

}  // namespace dmoscope
