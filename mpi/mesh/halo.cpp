#include "mpi/mesh/halo.h"

#include <algorithm>
#include <limits>

namespace dmoscope {

Halo::Halo(const World& world, const Share& share) : world_(world) {
  Dealer<WholeIndex> wanted(world.size());
  for (const int owner : share.owner)
    if (owner != world.rank()) wanted.count(owner);
  wanted.begin();
  for (std::size_t v = 0; v < share.owner.size(); ++v)
    if (share.owner[v] != world.rank()) wanted.put(share.owner[v], share.vertices[v]);
  const Parts<WholeIndex> asked = world.exchange(wanted.parts());
  std::size_t most = 0;
  for (int rank = 0; rank < world.size(); ++rank) {
    Neighbour neighbour{rank, {}, {}};
    for (const WholeIndex v : asked.of(rank)) neighbour.send.push_back(share.find_vertex(v));
    for (const WholeIndex v : wanted.parts().of(rank)) neighbour.receive.push_back(share.find_vertex(v));
    size_ += neighbour.receive.size();
    most = std::max({most, neighbour.send.size(), neighbour.receive.size()});
    if (!neighbour.send.empty() || !neighbour.receive.empty()) neighbours_.push_back(std::move(neighbour));
  }
  world.together([&] {  // MPI counts bytes in ints
    if (most > static_cast<std::size_t>(std::numeric_limits<int>::max()) / sizeof(Vec3))
      throw UsageError("two ranks have too many vertices in common: use --partition hilbert, or more ranks");
  });
}

}  // namespace dmoscope
