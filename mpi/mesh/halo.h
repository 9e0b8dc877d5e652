#pragma once
// Exchange of the positions of shared vertices between ranks.

#include <span>
#include <vector>

#include "mpi/mesh/share.h"
#include "mpi/world/world.h"

namespace dmoscope {

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
