#include "mpi/mesh/share.h"

#include <algorithm>
#include <array>
#include <bit>
#include <initializer_list>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "core/base/radix_sort.h"

namespace dmoscope {

namespace {

template <class T>
void release(std::vector<T>& values) {
  std::vector<T>().swap(values);
}

/// Search in an ascending list, fast for numbers near the one before.
class NearSearch {
 public:
  explicit NearSearch(std::span<const WholeIndex> list) : list_(list) {}
  /// Returns the place of a number that is in the list.
  Index find(WholeIndex number) {
    std::size_t low = at_, high = at_, step = 1;
    if (list_[at_] < number) {
      while (high < list_.size() && list_[high] < number) {
        low = high;
        high = std::min(list_.size(), high + step);
        step *= 2;
      }
    } else {
      while (low > 0 && list_[low] > number) {
        high = low;
        low -= std::min(low, step);
        step *= 2;
      }
      high = std::min(list_.size(), high + 1);
    }
    at_ = static_cast<std::size_t>(
        std::lower_bound(list_.begin() + static_cast<std::ptrdiff_t>(low), list_.begin() + static_cast<std::ptrdiff_t>(high), number) -
        list_.begin());
    return static_cast<Index>(at_);
  }

 private:
  std::span<const WholeIndex> list_;
  std::size_t at_ = 0;
};

/// Adds the numbers, each once; stretch by stretch, since neighbours in a list mostly repeat each other.
void add_once(std::vector<WholeIndex>& all, std::span<const WholeIndex> numbers, unsigned bits) {
  constexpr std::size_t kStretch = std::size_t{1} << 21U;
  std::vector<WholeIndex> some;
  for (std::size_t first = 0; first < numbers.size(); first += kStretch) {
    const auto stretch = numbers.subspan(first, std::min(kStretch, numbers.size() - first));
    some.assign(stretch.begin(), stretch.end());
    radix_sort(some, bits, [](WholeIndex number) { return number; });
    all.insert(all.end(), some.begin(), std::unique(some.begin(), some.end()));
  }
}

/// Returns all numbers of these lists, sorted, each once. `most`: no number is greater.
std::vector<WholeIndex> sorted_once(std::initializer_list<std::span<const WholeIndex>> lists, WholeIndex most) {
  const auto bits = static_cast<unsigned>(std::bit_width(most));
  std::vector<WholeIndex> all;
  for (const std::span<const WholeIndex> list : lists) add_once(all, list, bits);
  radix_sort(all, bits, [](WholeIndex number) { return number; });
  all.erase(std::unique(all.begin(), all.end()), all.end());
  all.shrink_to_fit();
  return all;
}

/// The ranks that own corners of an element, each once.
class OwnersOfElement {
 public:
  void add(int rank) {
    for (std::size_t i = 0; i < count_; ++i)
      if (ranks_[i] == rank) return;
    ranks_[count_++] = rank;
  }
  [[nodiscard]] std::span<const int> ranks() const noexcept { return {ranks_.data(), count_}; }

 private:
  std::array<int, 8> ranks_{};
  std::size_t count_ = 0;
};

/// Sends the block's elements to all ranks that own one of their corners.
class ElementDealer {
 public:
  ElementDealer(const World& world, MeshBlock& block, const std::vector<int>& part) : world_(world), block_(block) {
    const std::vector<WholeIndex> used = sorted_once({block.corners}, block.vertices.size());
    const WholeIndex first = block.vertices.begin(world.rank());
    const std::vector<int> owners = ask_holders<int>(world, block.vertices, used, [&](WholeIndex v) { return part[v - first]; });
    NearSearch search(used);
    to_offsets_.push_back(0);
    std::size_t at = 0;
    for (const ElementKind kind : block.kinds) {
      OwnersOfElement ranks;
      for (Index i = 0; i < info(kind).corners; ++i) ranks.add(owners[search.find(block.corners[at + i])]);
      at += info(kind).corners;
      to_.insert(to_.end(), ranks.ranks().begin(), ranks.ranks().end());
      to_offsets_.push_back(to_.size());
    }
  }
  /// Sends the values that `of(element, put)` puts for each element to the ranks that get the element.
  template <Plain T, class Of>
  [[nodiscard]] std::vector<T> deal(const Of& of) const {
    const auto each = [&](const auto& give) {
      for (std::size_t e = 0; e < block_.kinds.size(); ++e)
        of(e, [&](const T& value) {
          for (std::size_t i = to_offsets_[e]; i < to_offsets_[e + 1]; ++i) give(to_[i], value);
        });
    };
    return world_.exchange(dmoscope::deal<T>(world_, each)).values;
  }

 private:
  const World& world_;
  MeshBlock& block_;
  std::vector<int> to_;
  std::vector<std::size_t> to_offsets_;
};

struct PlacedVertex {
  Vec3 position;
  int owner;
  std::uint8_t named;
};

class ShareMaker {
 public:
  ShareMaker(const World& world, MeshBlock& block, const std::vector<int>& part, std::span<const std::size_t> materials,
             const BlockMarks& marks)
      : world_(world), block_(block), part_(part), materials_(materials), marks_(marks) {}

  Share make() {
    share_.vertex_count = block_.vertices.size();
    share_.element_count = block_.elements.size();
    share_.mesh.single_precision = block_.single_precision;
    elements();
    vertices();
    mesh();
    groups();
    return std::move(share_);
  }

 private:
  void elements() {
    const ElementDealer dealer(world_, block_, part_);
    const WholeIndex first = block_.elements.begin(world_.rank());
    share_.elements = dealer.deal<WholeIndex>([&](std::size_t e, const auto& put) { put(first + e); });
    kinds_ = dealer.deal<ElementKind>([&](std::size_t e, const auto& put) { put(block_.kinds[e]); });
    labels_ = dealer.deal<double>([&](std::size_t e, const auto& put) {
      for (const std::size_t f : materials_) put(block_.fields[f].values[e]);
    });
    if (world_.any(!marks_.elements.empty()))
      element_marks_ = dealer.deal<std::uint8_t>([&](std::size_t e, const auto& put) { put(marks_.elements[e]); });
    std::size_t at = 0, seen = 0;
    corners_ = dealer.deal<WholeIndex>([&](std::size_t e, const auto& put) {
      if (e == 0) at = 0, seen = 0;
      for (; seen < e; ++seen) at += info(block_.kinds[seen]).corners;
      for (Index i = 0; i < info(block_.kinds[e]).corners; ++i) put(block_.corners[at + i]);
    });
    release(block_.corners);
    release(block_.kinds);
    release(block_.fields);
  }

  /// Collects the owned vertices and the other corners of elements.
  void vertices() {
    const WholeIndex first = block_.vertices.begin(world_.rank());
    const auto each = [&](const auto& give) {
      for (std::size_t v = 0; v < part_.size(); ++v) give(part_[v], first + v);
    };
    const std::vector<WholeIndex> owned = world_.exchange(deal<WholeIndex>(world_, each)).values;
    share_.vertices = sorted_once({owned, corners_}, block_.vertices.size());
    world_.together([&] {
      if (share_.vertices.size() >= kNoIndex || corners_.size() >= kNoIndex)
        throw UsageError("a rank's share of the mesh has 2^32 corners or more: use more ranks");
    });
    const bool named = world_.any(marks_.any());
    const auto placed = ask_holders<PlacedVertex>(world_, block_.vertices, share_.vertices, [&](WholeIndex v) {
      const std::size_t i = v - first;
      return PlacedVertex{block_.positions[i], part_[i], marks_.vertices.empty() ? std::uint8_t{0} : marks_.vertices[i]};
    });
    release(block_.positions);
    share_.mesh.positions.reserve(placed.size());
    share_.owner.reserve(placed.size());
    if (named) share_.named.reserve(placed.size());
    for (const PlacedVertex& one : placed) {
      share_.mesh.positions.push_back(one.position);
      share_.owner.push_back(one.owner);
      if (named) share_.named.push_back(one.named);
    }
  }

  void mesh() {
    share_.mesh.elements.reserve(kinds_.size(), corners_.size());
    share_.home.reserve(kinds_.size());
    NearSearch search(share_.vertices);
    std::array<Index, 8> own{};
    std::size_t at = 0;
    for (std::size_t e = 0; e < kinds_.size(); ++e) {
      const std::span<Index> corners(own.data(), info(kinds_[e]).corners);
      for (Index& corner : corners) corner = search.find(corners_[at++]);
      share_.mesh.elements.add(kinds_[e], corners);
      share_.home.push_back(share_.owner[std::ranges::min(corners)] == world_.rank() ? 1 : 0);
      if (!element_marks_.empty() && element_marks_[e] != 0)
        for (const Index corner : corners) share_.named[corner] = 1;
    }
    release(corners_);
  }

  /// Makes a group for each value of each field that names materials, and one for each string.
  void groups() {
    for (std::size_t f = 0; f < materials_.size(); ++f) {
      std::map<double, std::vector<Index>> members;
      for (Index e = 0; e < share_.mesh.elements.size(); ++e) members[labels_[e * materials_.size() + f] + 0.0].push_back(e);
      for (auto& [value, elements] : members)
        share_.mesh.groups.push_back(
            {.name = fmt::format("{}", value), .role = "material", .dimension = 2, .members = std::move(elements)});
    }
    for (const VertexString& string : block_.strings) {
      Group group{.name = string.name, .role = "land boundary", .dimension = 0};
      for (const WholeIndex v : string.vertices)
        if (const Index here = share_.find_vertex(v); here != kNoIndex) group.members.push_back(here);
      if (!group.members.empty()) share_.mesh.groups.push_back(std::move(group));
    }
  }

  const World& world_;
  MeshBlock& block_;
  const std::vector<int>& part_;
  std::span<const std::size_t> materials_;
  const BlockMarks& marks_;
  Share share_;
  std::vector<ElementKind> kinds_;
  std::vector<WholeIndex> corners_;
  std::vector<double> labels_;  // element after element, one label a field
  std::vector<std::uint8_t> element_marks_;
};

}  // namespace

Index Share::find_vertex(WholeIndex vertex) const {
  const auto found = std::ranges::lower_bound(vertices, vertex);
  return found == vertices.end() || *found != vertex ? kNoIndex : static_cast<Index>(found - vertices.begin());
}

Share make_share(const World& world, MeshBlock& block, const std::vector<int>& part, std::span<const std::size_t> materials,
                 const BlockMarks& marks) {
  return ShareMaker(world, block, part, materials, marks).make();
}

Halo::Halo(const World& world, const Share& share) : world_(world) {
  const Parts<WholeIndex> wanted = deal<WholeIndex>(world, [&](const auto& give) {
    for (std::size_t v = 0; v < share.owner.size(); ++v)
      if (share.owner[v] != world.rank()) give(share.owner[v], share.vertices[v]);
  });
  const Parts<WholeIndex> asked = world.exchange(wanted);
  std::size_t most = 0;
  for (int rank = 0; rank < world.size(); ++rank) {
    Neighbour neighbour{rank, {}, {}};
    for (const WholeIndex v : asked.of(rank)) neighbour.send.push_back(share.find_vertex(v));
    for (const WholeIndex v : wanted.of(rank)) neighbour.receive.push_back(share.find_vertex(v));
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
