#include "mpi/mesh/shared_colouring.h"

#include <algorithm>
#include <numeric>

namespace dmoscope {
namespace {

class Colourer {
 public:
  Colourer(const World& world, const Share& share, const Halo& halo, const Mesh& mesh, const Topology& topology,
           std::span<const std::uint8_t> fixed)
      : world_(world), share_(share), halo_(halo), mesh_(mesh), topology_(topology), fixed_(fixed), waits_for_(share.vertices.size(), 0) {
    found_.of_vertex.assign(share.vertices.size(), kNoColour);
    find_listeners();
  }

  SharedColours colour() {
    for (Index v = 0; v < waits_for_.size(); ++v) {
      if (!is_mine(v)) continue;
      ++left_;
      // A neighbour counts once for each corner of each element, as often as it is counted down.
      for_others(v, [&](Index other) { waits_for_[v] += other < v && fixed_[other] == 0 ? 1U : 0U; });
      if (waits_for_[v] == 0) ready_.push_back(v);
    }
    std::ranges::reverse(ready_);  // taken from the back, the first vertex first
    // The test whether all are done is made ever more seldom: it takes as long as a round.
    for (std::uint64_t next_question = 0;;) {
      if (found_.rounds >= next_question) {
        if (!world_.any(left_ > 0)) break;
        next_question = found_.rounds + std::clamp<std::uint64_t>(found_.rounds / 8, 1, 64);
      }
      colour_ready();
      tell_others();
      ++found_.rounds;
    }
    found_.classes = static_cast<Index>(world_.greatest(std::uint64_t{classes_}));
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool is_mine(Index v) const { return share_.owner[v] == world_.rank() && fixed_[v] == 0; }
  template <class Visit>
  void for_others(Index v, const Visit& visit) const {
    for (const Incidence& at : topology_.star(v))
      for (const Index other : mesh_.elements.corners(at.element))
        if (other != v) visit(other);
  }

  void colour_ready() {
    while (!ready_.empty()) {
      const Index v = ready_.back();
      ready_.pop_back();
      for_others(v, [&](Index other) {
        const Index colour = found_.of_vertex[other];
        if (colour == kNoColour) return;
        if (colour >= taken_by_.size()) taken_by_.resize(colour + std::size_t{1}, kNoIndex);
        taken_by_[colour] = v;
      });
      Index lowest = 0;
      while (lowest < taken_by_.size() && taken_by_[lowest] == v) ++lowest;
      --left_;
      set(v, lowest);
    }
  }

  /// Sets a vertex's colour; free neighbours after it wait for one fewer.
  void set(Index v, Index colour) {
    found_.of_vertex[v] = colour;
    for (Index i = first_listener_[v]; i < first_listener_[v + 1]; ++i)
      news_[listeners_[i].neighbour].push_back({listeners_[i].place, colour});
    classes_ = std::max(classes_, colour + 1);
    for_others(v, [&](Index other) {
      if (other > v && is_mine(other) && --waits_for_[other] == 0) ready_.push_back(other);
    });
  }

  /// Exchanges the colours that are new since the last round.
  void tell_others() {
    constexpr int kTag = 22;
    const auto neighbours = halo_.neighbours();
    std::vector<MPI_Request> receives(neighbours.size()), sends(neighbours.size());
    for (std::size_t n = 0; n < neighbours.size(); ++n) {
      MPI_Irecv(from_[n].data(), bytes(from_[n]), MPI_BYTE, neighbours[n].rank, kTag, world_.comm(), &receives[n]);
      MPI_Isend(news_[n].data(), bytes(news_[n]), MPI_BYTE, neighbours[n].rank, kTag, world_.comm(), &sends[n]);
    }
    std::vector<MPI_Status> came(neighbours.size());
    MPI_Waitall(static_cast<int>(receives.size()), receives.data(), came.data());
    MPI_Waitall(static_cast<int>(sends.size()), sends.data(), MPI_STATUSES_IGNORE);
    for (std::size_t n = 0; n < neighbours.size(); ++n) {
      int count = 0;
      MPI_Get_count(&came[n], MPI_BYTE, &count);
      news_[n].clear();
      for (const News& one : std::span(from_[n]).first(static_cast<std::size_t>(count) / sizeof(News)))
        set(neighbours[n].receive[one.place], one.colour);
    }
  }
  template <class T>
  static int bytes(const std::vector<T>& values) {
    return static_cast<int>(values.size() * sizeof(T));
  }

  /// Finds the place of each owned vertex in the neighbours' lists.
  void find_listeners() {
    const auto neighbours = halo_.neighbours();
    news_.resize(neighbours.size());
    for (const Halo::Neighbour& neighbour : neighbours) from_.emplace_back(neighbour.receive.size());
    first_listener_.assign(share_.vertices.size() + 1, 0);
    for (const Halo::Neighbour& neighbour : neighbours)
      for (const Index v : neighbour.send) ++first_listener_[v + 1];
    std::partial_sum(first_listener_.begin(), first_listener_.end(), first_listener_.begin());
    listeners_.resize(first_listener_.back());
    std::vector<Index> next(first_listener_.begin(), first_listener_.end() - 1);
    for (std::uint32_t n = 0; n < neighbours.size(); ++n)
      for (std::uint32_t place = 0; place < neighbours[n].send.size(); ++place) listeners_[next[neighbours[n].send[place]]++] = {n, place};
  }

  struct Listener {
    std::uint32_t neighbour, place;
  };
  struct News {
    std::uint32_t place;  // place in the neighbour's list
    Index colour;
  };
  const World& world_;
  const Share& share_;
  const Halo& halo_;
  const Mesh& mesh_;
  const Topology& topology_;
  std::span<const std::uint8_t> fixed_;
  SharedColours found_;
  std::vector<std::uint32_t> waits_for_;  // by vertex: corners of its star's elements that are to be coloured before it
  std::vector<Index> ready_, taken_by_;
  std::vector<Index> first_listener_;  // by vertex: start of its stretch in listeners_
  std::vector<Listener> listeners_;
  std::vector<std::vector<News>> news_, from_;  // one list for each neighbour to send, and one to receive
  std::uint64_t left_ = 0;
  Index classes_ = 0;
};

}  // namespace

SharedColours colour_shares(const World& world, const Share& share, const Halo& halo, const Mesh& mesh, const Topology& topology,
                            std::span<const std::uint8_t> fixed) {
  return Colourer(world, share, halo, mesh, topology, fixed).colour();
}

}  // namespace dmoscope
