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

/// Roles of groups from an Exodus file.
inline constexpr std::string_view kExodusBlock = "element block";
inline constexpr std::string_view kExodusNodeSet = "node set";
inline constexpr std::string_view kExodusSideSet = "side set";

/// The shape of a block's element type ("HEX8", "tri") with this number of nodes; none for types that are not read: elements of higher
/// order, polyhedra.
[[nodiscard]] std::optional<CellShape> exodus_shape(std::string_view word, std::uint64_t nodes) noexcept;

/// A side of an element, from 1 as in the file, by 2 to 4 of the element's own corners from 0, outward. Empty if it has no such side.
/// `has_faces`: it is a shell whose first two sides are its front and back, as in space.
[[nodiscard]] std::span<const Index> exodus_side(CellShape shape, bool has_faces, std::int64_t side) noexcept;
/// Whether the element type is a shell, which has faces among its sides.
[[nodiscard]] bool is_exodus_shell(std::string_view word) noexcept;

/// Reads the coordinates into `positions`, which is resized. Throws InputError.
[[nodiscard]] CoordinateArrays read_exodus_points(ArrayFile& file, std::vector<Vec3>& positions);

}  // namespace dmoscope
