#pragma once
// The part of a mesh that a rank smooths: the vertices that it owns, all elements around them, and the other corners of these.

#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "mpi/mesh/mesh_block.h"
#include "mpi/world/world.h"

namespace dmoscope {

struct Share {
  std::uint64_t vertex_count = 0, element_count = 0;  // counts of the whole mesh
  std::vector<WholeIndex> vertices, elements;         // numbers in the whole mesh, ascending, by vertex and element of the share
  std::vector<int> owner;                             // by vertex: its owner's rank
  std::vector<std::uint8_t> home;                     // by element: 1 on the one rank that counts it
  std::vector<std::uint8_t> named;                    // by vertex: 1 if owned and marked in the block; empty: none
  Mesh mesh;                                          // without fields; its groups of elements tell materials apart
  /// Returns the share's number of a vertex of the whole mesh; kNoIndex: it is not in the share.
  [[nodiscard]] Index find_vertex(WholeIndex vertex) const;
};

/// Marks of a block's vertices and elements that the user named. Empty: none.
struct BlockMarks {
  std::vector<std::uint8_t> vertices, elements;
  [[nodiscard]] bool any() const noexcept { return !vertices.empty() || !elements.empty(); }
};

/// Makes the rank's share. `part`: the rank of each of the block's vertices; `materials`: numbers of block.fields. Moves the block's
/// contents out, but for the ranges. Throws InputError if a share has more vertices or elements than an Index counts.
[[nodiscard]] Share make_share(const World& world, MeshBlock& block, const std::vector<int>& part, std::span<const std::size_t> materials,
                               const BlockMarks& marks);

// Exchange of the positions of shared vertices between ranks.

class Halo {
 public:
  struct Neighbour {
    int rank;
    std::vector<Index> send;     // owned vertices in the other rank's share, ascending
    std::vector<Index> receive;  // the other's vertices in this share, ascending: its `send`, in the same order
  };
  /// Finds the neighbours; all ranks together.
  Halo(const World& world, const Share& share);
  [[nodiscard]] std::span<const Neighbour> neighbours() const noexcept { return neighbours_; }
  /// Number of others' vertices in this share.
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

  /// Updates values by vertex: those of others' vertices become their owners' values.
  template <Plain T>
  void agree(std::span<T> values) const {
    constexpr int kTag = 21;
    std::vector<std::vector<T>> to(neighbours_.size()), from(neighbours_.size());
    std::vector<MPI_Request> requests(2 * neighbours_.size());
    for (std::size_t n = 0; n < neighbours_.size(); ++n) {
      from[n].resize(neighbours_[n].receive.size());
      to[n].reserve(neighbours_[n].send.size());
      for (const Index v : neighbours_[n].send) to[n].push_back(values[v]);
      MPI_Irecv(from[n].data(), bytes(from[n]), MPI_BYTE, neighbours_[n].rank, kTag, world_.comm(), &requests[2 * n]);
      MPI_Isend(to[n].data(), bytes(to[n]), MPI_BYTE, neighbours_[n].rank, kTag, world_.comm(), &requests[2 * n + 1]);
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    for (std::size_t n = 0; n < neighbours_.size(); ++n)
      for (std::size_t i = 0; i < from[n].size(); ++i) values[neighbours_[n].receive[i]] = from[n][i];
  }

 private:
  template <class T>
  static int bytes(const std::vector<T>& values) {
    return static_cast<int>(values.size() * sizeof(T));
  }
  World world_;
  std::vector<Neighbour> neighbours_;
  std::uint64_t size_ = 0;
};

}  // namespace dmoscope
