// A rank's share has the data of its vertices and elements that one process finds for the whole mesh.

#include <algorithm>
#include <bit>
#include <map>

#include "core/mesh/colouring.h"
#include "core/quality/quality.h"
#include "core/reference/standing.h"
#include "mpi/smooth/rank_share.h"
#include "mpi/smooth/shared_statistics.h"
#include "tests/mpi/blocks.h"
#include "tests/support/testing.h"

namespace dmoscope::testing {
namespace {

constexpr PartitionChoice::Kind kKinds[] = {PartitionChoice::Kind::Hilbert, PartitionChoice::Kind::Block};

TEST(Shares, HaveAllElementsAroundTheirVertices) {
  const World world;
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    for (const auto kind : kKinds) {
      const SharedMesh mesh = shared(world, sample.mesh, kind);
      const Share& share = mesh.share->share();
      std::map<WholeIndex, Index> element;
      for (Index e = 0; e < share.elements.size(); ++e) element[share.elements[e]] = e;
      std::uint64_t owned = 0, counted = 0;
      for (Index v = 0; v < share.vertices.size(); ++v) owned += mesh.share->owns(v) ? 1U : 0U;
      for (const std::uint8_t home : share.home) counted += home;
      EXPECT_EQ(world.sum(owned), sample.mesh.positions.size());
      EXPECT_EQ(world.sum(counted), sample.mesh.elements.size());
      for (Index e = 0; e < sample.mesh.elements.size(); ++e) {
        const auto corners = sample.mesh.elements.corners(e);
        const bool touches = std::ranges::any_of(corners, [&](Index v) {
          const Index here = share.find_vertex(v);
          return here != kNoIndex && mesh.share->owns(here);
        });
        ASSERT_EQ(element.contains(e), touches);
        if (!touches) continue;
        const auto here = mesh.input->mesh.elements.corners(element[e]);
        std::vector<WholeIndex> mine, theirs(corners.begin(), corners.end());
        for (const Index v : here) mine.push_back(share.vertices[v]);
        std::ranges::sort(mine);
        std::ranges::sort(theirs);
        EXPECT_EQ(mine, theirs);
      }
    }
  }
}

TEST(Shares, KnowBoundaryOrientationAndMeasures) {
  const World world;
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const auto whole = whole_input(sample.mesh);
    for (const auto kind : kKinds) {
      const SharedMesh mesh = shared(world, sample.mesh, kind);
      const Share& share = mesh.share->share();
      EXPECT_EQ(mesh.input->has_strays, whole->has_strays);
      EXPECT_EQ(mesh.findings.inverted.count, whole->report.inverted_elements.size());
      EXPECT_EQ(mesh.findings.flipped, whole->report.flipped_elements);
      EXPECT_EQ(mesh.findings.held, whole->interfaces.count());
      for (Index v = 0; v < share.vertices.size(); ++v) {
        EXPECT_EQ(mesh.input->topology.boundary()[v], whole->topology.boundary()[share.vertices[v]]);
        if (mesh.share->owns(v)) {
          EXPECT_EQ(mesh.input->interfaces.holds(v), whole->interfaces.holds(static_cast<Index>(share.vertices[v])));
        }
      }
      for (Index e = 0; e < share.elements.size(); ++e) {
        const auto at = static_cast<Index>(share.elements[e]);
        EXPECT_EQ(std::bit_cast<std::uint64_t>(mesh.input->reference_measure[e]),
                  std::bit_cast<std::uint64_t>(whole->reference_measure[at]));
        const auto here = mesh.input->mesh.elements.corners(e), there = whole->mesh.elements.corners(at);
        for (std::size_t i = 0; i < here.size(); ++i) ASSERT_EQ(share.vertices[here[i]], there[i]) << "element " << at;
      }
    }
  }
}

TEST(Shares, AreColouredAsTheWholeMesh) {
  const World world;
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const auto whole = whole_input(sample.mesh);
    const std::vector<std::uint8_t> fixed = standing_vertices(*whole, {});
    std::vector<Index> free, colour(fixed.size(), kNoColour);
    for (Index v = 0; v < fixed.size(); ++v)
      if (fixed[v] == 0) free.push_back(v);
    const Colouring colouring = colour_vertices(whole->mesh, whole->topology, free);
    for (Index c = 0; c < colouring.class_count(); ++c)
      for (const Index v : colouring.members(c)) colour[v] = c;
    for (const auto kind : kKinds) {
      const SharedMesh mesh = shared(world, sample.mesh, kind);
      const Share& share = mesh.share->share();
      std::vector<std::uint8_t> mine;
      for (const WholeIndex v : share.vertices) mine.push_back(fixed[v]);
      const SharedColours found = colour_shares(world, share, mesh.share->halo(), mesh.input->mesh, mesh.input->topology, mine);
      EXPECT_EQ(found.classes, colouring.class_count());
      for (Index v = 0; v < share.vertices.size(); ++v)
        ASSERT_EQ(found.of_vertex[v], colour[share.vertices[v]]) << "vertex " << share.vertices[v];
    }
  }
}

TEST(Shares, HaveTheStatisticsOfTheWholeMesh) {
  const World world;
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const auto whole = whole_input(sample.mesh);
    const std::vector<Index> immovable = immovable_elements(whole->mesh, standing_vertices(*whole, {}), nullptr);
    const SharedMesh mesh = shared(world, sample.mesh);
    const Share& share = mesh.share->share();
    std::vector<Index> mine;
    for (Index e = 0; e < share.elements.size(); ++e)
      if (std::ranges::binary_search(immovable, static_cast<Index>(share.elements[e]))) mine.push_back(e);
    for (const Metric metric : {Metric::MeanRatio, Metric::ScaledJacobian, Metric::MinAngle}) {
      const Statistics want = compute_statistics(whole->quality_context(), whole->mesh.positions, metric, immovable, nullptr);
      ThreadPool pool(2);
      const Statistics got = mesh.share->statistics(mesh.input->quality_context(), mesh.input->mesh.positions, metric, mine, &pool);
      EXPECT_EQ(std::bit_cast<std::uint64_t>(got.minimum), std::bit_cast<std::uint64_t>(want.minimum));
      EXPECT_EQ(std::bit_cast<std::uint64_t>(got.mean), std::bit_cast<std::uint64_t>(want.mean));
      EXPECT_EQ(got.movable_minimum, want.movable_minimum);
      EXPECT_EQ(got.ceiling, want.ceiling);
      EXPECT_EQ(got.worst_element, want.worst_element);
      EXPECT_EQ(got.inverted, want.inverted);
    }
  }
}

TEST(Shares, FindValuesByTheirRank) {
  const World world;
  Random random(11);
  for (const std::size_t count : {std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
    std::vector<double> all, mine;
    for (std::size_t i = 0; i < count; ++i) {
      const double value = i % 5 == 0 ? -0.25 : static_cast<double>(random.below(1000)) / 500.0 - 1.0;
      all.push_back(value);
      if (i % static_cast<std::size_t>(world.size()) == static_cast<std::size_t>(world.rank())) mine.push_back(value);
    }
    std::ranges::sort(all);
    std::ranges::sort(mine);
    const std::vector<std::uint64_t> ranks{0, count / 3, count / 2, count - 1};
    const std::vector<double> found = values_of_ranks(world, mine, ranks);
    for (std::size_t i = 0; i < ranks.size(); ++i) EXPECT_EQ(found[i], all[ranks[i]]);
  }
}

TEST(Shares, RefuseWhatNeedsAllOfTheMesh) {
  const World world;
  for (const char* name : {"can", "wrapped"}) {
    const Mesh mesh = generated(name, 300);
    EXPECT_THROW((void)shared(world, mesh), SharedError) << name;
  }
  Mesh tilted = generated("grid", 50);
  for (Vec3& p : tilted.positions) p.z = 0.5 * p.x;
  EXPECT_THROW((void)shared(world, tilted), SharedError);
}

TEST(World, TellsAllRanksOfTheFirstError) {
  const World world;
  const int last = world.size() - 1;
  try {
    world.together([&] {
      if (world.rank() == last) throw InputError("mesh.obj", 12, "a bad number");
    });
    FAIL() << "nothing thrown";
  } catch (const SharedError& error) {
    EXPECT_EQ(error.exit_code(), 3);
    EXPECT_THAT(error.what(), HasSubstr("mesh.obj:12: a bad number"));
    if (world.size() > 1) {
      EXPECT_THAT(error.what(), HasSubstr("rank " + std::to_string(last)));
    }
  }
  EXPECT_NO_THROW(world.together([] {}));
}

TEST(World, DealsRangesEvenly) {
  for (const std::uint64_t size : {0U, 1U, 5U, 4096U, 100'000U})
    for (const int ranks : {1, 3, 7}) {
      const Ranges ranges(size, ranks, 1024);
      EXPECT_EQ(ranges.size(), size);
      for (int r = 0; r < ranks; ++r) {
        EXPECT_TRUE(ranges.begin(r) % 1024 == 0 || ranges.begin(r) == size);
        for (std::uint64_t i = ranges.begin(r); i < ranges.end(r); i += 777) EXPECT_EQ(ranges.holder(i), r);
      }
    }
}

}  // namespace
}  // namespace dmoscope::testing
