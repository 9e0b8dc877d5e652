#pragma once
// Loading of a mesh file as shares that ranks smooth, and the way back.

#include <filesystem>
#include <memory>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/collapsed.h"
#include "mpi/files/shared_mesh_file.h"
#include "mpi/mesh/partition.h"
#include "mpi/mesh/vertex_marks.h"
#include "mpi/smooth/rank_share.h"

namespace dmoscope {

/// Findings about the whole mesh for the user: counts, each with the lowest number of such an element.
struct SharedFindings {
  struct Some {
    std::uint64_t count = 0;
    WholeIndex first = 0;
  };
  Some inverted, degenerate;
  std::uint64_t flipped = 0, held = 0;  // elements turned over; vertices on interfaces
  bool volume = false;
  CollapsedKinds collapsed{};
  /// One sentence per finding, as in MeshReport.
  [[nodiscard]] std::vector<std::string> sentences() const;
};

struct SharedMesh {
  std::shared_ptr<const RankShare> share;
  std::shared_ptr<const InputMesh> input;  // mesh of the share
  std::vector<Index> named;                // owned vertices that the user named
  SharedFindings findings;
  Ranges vertices;  // ranges of the block that positions_of_block() fills
};

/// Loads the file, all ranks together. Throws InputError for meshes that ranks cannot share: curved surfaces, planar meshes of no
/// coordinate plane, and those that wrap around the Earth; and errors of reading (as SharedError on all).
[[nodiscard]] SharedMesh load_shared(const World& world, SharedMeshFile& file, const std::filesystem::path& path,
                                     const PartitionChoice& partition, const SharedVertexWords& named, Need need);

/// Makes the shares of a block that was not read from a file, as load_shared() does.
[[nodiscard]] SharedMesh share_block(const World& world, MeshBlock block, const std::filesystem::path& path,
                                     const PartitionChoice& partition, const SharedVertexWords& named, Need need);

/// Returns the positions of this rank's block. `positions`: of the share. To be called by all ranks together.
[[nodiscard]] std::vector<Vec3> positions_of_block(const SharedMesh& mesh, std::span<const Vec3> positions);

}  // namespace dmoscope
