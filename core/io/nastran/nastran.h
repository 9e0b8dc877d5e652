#pragma once
// Interfaces that the parts of Nastran's bulk data format (.bdf, .nas, .dat) share.
// MSC Nastran Quick Reference Guide: Format of Bulk Data Entries; GRID, CTETRA, CPYRAM, CPENTA, CHEXA, CTRIA3, CQUAD4.

#include <cstddef>
#include <string_view>

#include "core/io/format.h"

namespace dmoscope {

inline constexpr std::size_t kNastranNumber = 16;  // characters of a number in a large field
inline constexpr std::string_view kNastranProperty = "property";

/// Reader, see FormatHandler. Free, small and large fields. Throws InputError, Cancelled.
Mesh read_nastran(SourceFile& source, const IoContext& context);
/// Writer, see FormatHandler: nodes in large fields, elements in small ones. Throws OutputError, Cancelled.
Notes write_nastran(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);
/// Patcher, see FormatHandler: a node that moved gets large fields in any case.
Notes patch_nastran(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context);

}  // namespace dmoscope
