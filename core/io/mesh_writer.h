#pragma once
// Base of the writers of new files in text formats.

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/boundary_strings.h"
#include "core/io/cell_table.h"
#include "core/io/format.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {

class MeshWriter {
 protected:
  /// Begins a file. `title`: of the format; `strings_as`: form of boundary strings, see groups_with_edges(); empty: no groups are written.
  MeshWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context, std::string_view title,
             std::string_view strings_as = {})
      : out_(file, context), mesh_(mesh), positions_(positions), title_(title) {
    if (strings_as.empty()) return;
    groups_ = groups_with_edges(mesh, strings_as, notes_);
    numbers_ = numbers_of_groups(groups_);
  }

  [[nodiscard]] bool is_volume() const {
    return std::ranges::any_of(mesh_.elements.kinds(), [](ElementKind kind) { return info(kind).dimension == 3; });
  }
  /// Whether the mesh is planar and in the plane z = 0.
  [[nodiscard]] bool is_flat() const {
    return !is_volume() && std::ranges::all_of(positions_, [](Vec3 p) { return p.z == 0.0; });
  }
  /// Completes the notes, at the end of the file.
  [[nodiscard]] Notes finish() {
    out_.finish();
    note_dropped(mesh_, kept_fields_, kept_groups_, title_, notes_);
    return std::move(notes_);
  }

  TextWriter out_;
  const Mesh& mesh_;
  std::span<const Vec3> positions_;
  std::string_view title_;
  Notes notes_;
  std::vector<Group> groups_;  // groups of the mesh, boundary strings by their edges
  std::vector<int> numbers_;   // numbers of the groups
  std::vector<std::size_t> kept_fields_, kept_groups_;
};

}  // namespace dmoscope
