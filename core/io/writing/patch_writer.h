#pragma once
// Writing a file again with nothing changed but the coordinates that moved, and the fields that changed with them.

#include <span>
#include <string>
#include <vector>

#include "core/io/reading/binary_scalar.h"
#include "core/io/reading/io_context.h"
#include "core/io/writing/atomic_file.h"
#include "core/io/writing/text_writer.h"
#include "core/mesh/mesh.h"
#include "core/mesh/moved_mesh.h"

namespace dmoscope {

/// Writes the bytes of mesh.source with every number replaced whose bits in `moved` differ from those of the mesh (which are the file's
/// own): coordinates, and fields whose Field::Place says where they are. Text: the shortest decimal number that reads back as the same
/// number; binary: the file's scalar, rounded to what it holds. All else stays byte for byte. mesh.source must be there and patchable, with
/// a place for every vertex. Returns notes (rounding; fields whose place is not known).
/// Throws OutputError (z of a file that has only x and y; too large for a float), Cancelled.
std::vector<std::string> write_patched(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context);

/// The shortest decimal number that reads back as the same number of its type.
void put_number(TextBuffer& out, double value, ScalarType type);

/// The coordinates alone of a part of a file, into memory: `source` holds a part alone, with its places; `before` and `after` are by place.
/// `file`: what errors call the target. Returns how many coordinates were rounded. Throws OutputError.
std::size_t patch_part(TextBuffer& out, const std::string& file, const SourceFile& source, std::span<const Vec3> before,
                       std::span<const Vec3> after);

}  // namespace dmoscope
