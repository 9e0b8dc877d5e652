#pragma once
// Writing of a file with nothing changed except the coordinates that moved, and the fields that changed with them.

#include <span>
#include <string>
#include <vector>

#include "core/io/reading/binary.h"
#include "core/io/reading/io_context.h"
#include "core/io/writing/atomic_file.h"
#include "core/io/writing/text_writer.h"
#include "core/mesh/mesh.h"
#include "core/mesh/moved_mesh.h"

namespace dmoscope {

/// Writes the bytes of mesh.source with every number replaced whose bits in `moved` differ from those of the mesh (which are the file's
/// own): coordinates, and fields with a Field::Place. Text: the shortest decimal number that reads back as the same number; binary: the
/// file's scalar, rounded to its precision. All else stays byte for byte. mesh.source must exist and be patchable, with a place for every
/// vertex. Returns notes (rounding; fields without a known place). Throws OutputError (z of a file with only x and y; too large for a
/// float), Cancelled.
std::vector<std::string> write_patched(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context);

/// Writes the shortest decimal number that reads back as the same number of its type.
void put_number(TextBuffer& out, double value, ScalarType type);

/// Patches only the coordinates in a part of a file, in memory: `source` holds that part, with its places; `before` and `after` are by
/// place. `file`: name of the target in errors. Returns the number of rounded coordinates. Throws OutputError.
std::size_t patch_part(TextBuffer& out, const std::string& file, const SourceFile& source, std::span<const Vec3> before,
                       std::span<const Vec3> after);

}  // namespace dmoscope
