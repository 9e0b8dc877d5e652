#pragma once
// Writing a file again with nothing changed but the coordinates that moved.

#include <span>
#include <string>
#include <vector>

#include "core/io/reading/io_context.h"
#include "core/io/writing/atomic_file.h"
#include "core/io/writing/text_writer.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Writes the bytes of mesh.source with every x, y or z replaced whose bits in `positions` differ from those in mesh.positions (which
/// are the file's own). Text: the shortest decimal number that reads back as the same double; binary: the file's scalar, rounded to
/// float where that is one. All else stays byte for byte. mesh.source must be there and patchable, with a place for every vertex.
/// Returns notes (rounding). Throws OutputError (z of a file that has only x and y; too large for a float), Cancelled.
std::vector<std::string> write_patched(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

/// The same of a part of a file into memory: `source` holds a part alone, with its places; `before` and `after` are by place. `file`: what
/// errors call the target. Returns how many coordinates were rounded. Throws OutputError.
std::size_t patch_part(TextBuffer& out, const std::string& file, const SourceFile& source, std::span<const Vec3> before,
                       std::span<const Vec3> after);

}  // namespace dmoscope
