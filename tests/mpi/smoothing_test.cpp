// Ranks smooth a mesh to the bits of one process, with the same statistics after each iteration.

#include <algorithm>
#include <bit>

#include "core/base/same_bits.h"
#include "core/input/mesh_region.h"
#include "core/run/ending.h"
#include "core/run/run.h"
#include "tests/mpi/blocks.h"
#include "tests/support/inside.h"
#include "tests/support/meshes.h"
#include "tests/support/testing.h"

namespace dmoscope::testing {
namespace {

void expect_same(double a, double b, const char* what) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << what << ": " << a << " and " << b;
}

void expect_same_records(const std::vector<IterationRecord>& mine, const std::vector<IterationRecord>& theirs) {
  ASSERT_EQ(mine.size(), theirs.size());
  for (std::size_t i = 0; i < mine.size(); ++i) {
    SCOPED_TRACE("iteration " + std::to_string(i));
    expect_same(mine[i].statistics.minimum, theirs[i].statistics.minimum, "minimum");
    expect_same(mine[i].statistics.mean, theirs[i].statistics.mean, "mean");
    expect_same(mine[i].statistics.movable_minimum, theirs[i].statistics.movable_minimum, "movable minimum");
    EXPECT_EQ(mine[i].statistics.inverted, theirs[i].statistics.inverted);
    EXPECT_EQ(mine[i].statistics.worst_element, theirs[i].statistics.worst_element);
    EXPECT_EQ(mine[i].moved, theirs[i].moved);
    EXPECT_EQ(mine[i].searched, theirs[i].searched);
  }
}

void expect_same_positions(const SharedMesh& mesh, const Run& mine, const Run& theirs) {
  const Share& share = mesh.share->share();
  const auto here = mine.positions(), there = theirs.positions();
  for (Index v = 0; v < share.vertices.size(); ++v) {
    const Vec3 a = here[v], b = there[share.vertices[v]];
    ASSERT_TRUE(std::bit_cast<std::uint64_t>(a.x) == std::bit_cast<std::uint64_t>(b.x) &&
                std::bit_cast<std::uint64_t>(a.y) == std::bit_cast<std::uint64_t>(b.y) &&
                std::bit_cast<std::uint64_t>(a.z) == std::bit_cast<std::uint64_t>(b.z))
        << "vertex " << share.vertices[v] << (mesh.share->owns(v) ? "" : ", another rank's");
  }
}

/// Runs both for some iterations, and compares them.
void compare(const World& world, const Sample& sample, const RunParameters& parameters, std::uint64_t iterations) {
  SCOPED_TRACE(sample.name + ", " + parameters.method);
  const auto whole = whole_input(sample.mesh);
  const SharedMesh mesh =
      shared(world, sample.mesh, sample.name.size() % 2 == 0 ? PartitionChoice::Kind::Hilbert : PartitionChoice::Kind::Block);
  RunParameters p = parameters;
  p.backend = Backend::Cpu;
  Run theirs(whole, p, std::make_shared<ThreadPool>(1), 0);
  Run mine(mesh.input, p, std::make_shared<ThreadPool>(world.rank() % 2 == 0 ? 1 : 2), 0);
  Progress progress;
  theirs.iterate(iterations, progress);
  mine.iterate(iterations, progress);
  expect_same_records(mine.history().records(), theirs.history().records());
  expect_same_positions(mesh, mine, theirs);
  const auto left = find_left_inverted(mine);
  const auto left_there = find_left_inverted(theirs);
  ASSERT_EQ(left.has_value(), left_there.has_value());
  if (left) {
    EXPECT_EQ(left->sentence(), left_there->sentence());
  }
}

TEST(SharedSmoothing, HasTheSameBitsByDmo) {
  const World world;
  for (const Sample& sample : samples()) compare(world, sample, {}, 6);
}

TEST(SharedSmoothing, HasTheSameBitsByTheFirstSampleForLong) {
  const World world;
  compare(world, {"coast, long", generated("coast", 600, 9)}, {}, 60);
  compare(world, {"tangled, long", generated("tangled", 300, 4)}, {}, 60);
}

TEST(SharedSmoothing, HasTheSameBitsByOtherMethods) {
  const World world;
  for (const char* method : {"laplace", "smart-laplace", "angle-based", "dvr", "pattern-search", "active-set"})
    for (const Sample& sample : {Sample{"coast", generated("coast", 300)}, Sample{"solids", generated("solids", 150)}}) {
      if (std::string_view(method) == "angle-based" && sample.name == "solids") continue;
      RunParameters parameters;
      parameters.method = method;
      compare(world, sample, parameters, 4);
    }
}

TEST(SharedSmoothing, HasTheSameBitsByOtherMetricsAndInDouble) {
  const World world;
  for (const auto& [metric, name] : {std::pair(Metric::ScaledJacobian, "mixed"), std::pair(Metric::ScaledJacobian, "tetrahedra"),
                                     std::pair(Metric::MinAngle, "random")}) {
    RunParameters parameters;
    parameters.metric = metric;
    compare(world, {name, generated(name, 200)}, parameters, 3);
  }
  RunParameters parameters;
  parameters.search.precision = Precision::Double;
  compare(world, {"random", generated("random", 300)}, parameters, 3);
  compare(world, {"hexahedra", generated("hexahedra", 150)}, parameters, 2);
}

TEST(SharedSmoothing, HasTheSameBitsByTwoAims) {
  const World world;
  RunParameters parameters;
  parameters.combination = CompositeTerms{0.5, Metric::ScaledJacobian};
  compare(world, {"coast", generated("coast", 300)}, parameters, 4);
  compare(world, {"tetrahedra", generated("tetrahedra", 200)}, parameters, 3);
}

TEST(SharedSmoothing, HoldsInterfacesOrNot) {
  const World world;
  const Sample sample{"stripes", with_stripes(generated("random", 500))};
  RunParameters parameters;
  compare(world, sample, parameters, 4);
  parameters.interfaces = InterfaceRule::Free;
  compare(world, sample, parameters, 4);
}

TEST(SharedSmoothing, MovesFloatsToFloats) {
  const World world;
  Mesh mesh = generated("coast", 300);
  for (Vec3& p : mesh.positions) p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  mesh.single_precision = true;
  compare(world, {"floats", mesh}, {}, 4);
}

/// Hexahedra and wedges that are nearly or wholly inverted inside, which corners do not show.
TEST(SharedSmoothing, HasTheSameBitsWhereElementsAreAlmostInvertedInside) {
  const World world;
  RunParameters one_aim{.layers = LayerRule::Free}, other_method = one_aim, two_aims = one_aim;
  other_method.method = "pattern-search";
  two_aims.combination = CompositeTerms{0.3, Metric::ScaledJacobian};
  for (const Sample& sample :
       {Sample{"twisted block", test::twisted_block(3, test::Fill::Mixed, 11)}, Sample{"crushed can", test::crushed_can(0.6, 0.25, 5)}})
    for (const RunParameters& parameters : {one_aim, other_method, two_aims}) compare(world, sample, parameters, 4);
}

/// Both end at the same iteration, for the same reason, in the same phase, at the same positions.
TEST(SharedSmoothing, ConvergesWhereOneProcessDoes) {
  const World world;
  for (const bool then_mean : {false, true})
    for (const Sample& sample : {Sample{"random", generated("random", 200)}, Sample{"solids", generated("solids", 120)},
                                 Sample{"tangled", generated("tangled", 150)}, Sample{"nine vertices", generated("grid", 9)}}) {
      SCOPED_TRACE(sample.name);
      RunParameters parameters;
      parameters.backend = Backend::Cpu;
      if (then_mean) parameters.then_mean = PhaseBegin{.patience = 15};
      const SharedMesh mesh = shared(world, sample.mesh);
      dmoscope::Run theirs(whole_input(sample.mesh), parameters, std::make_shared<ThreadPool>(1), 0);
      dmoscope::Run mine(mesh.input, parameters, std::make_shared<ThreadPool>(1), 0);
      Progress progress;
      const ConvergenceLimits limits{.patience = 15, .max_iterations = 150};
      const Outcome want = theirs.until_converged(limits, progress), got = mine.until_converged(limits, progress);
      EXPECT_EQ(got.sentence(), want.sentence());
      EXPECT_EQ(got.iterations, want.iterations);
      theirs.end_at_best(progress);
      mine.end_at_best(progress);
      EXPECT_EQ(mine.moment(), theirs.moment());
      expect_same_records(mine.history().records(), theirs.history().records());
      expect_same_positions(mesh, mine, theirs);
    }
}

/// Many vertices move for a long time, and one whose neighbours all stay has one of them far too near.
TEST(SharedSmoothing, EndsByTheSameCertificate) {
  const World world;
  constexpr Index kSide = 90, kVertex = 45 * (kSide + 1) + 45;
  Mesh mesh = lattice(kSide, 0.3, 5);
  mesh.positions[kVertex] = {0.5, 0.5, 0.0};
  mesh.positions[kVertex + 1] = {0.5 + 0.1 / kSide, 0.5, 0.0};
  RunParameters parameters;
  parameters.backend = Backend::Cpu;
  const SharedMesh part = shared(world, mesh);
  std::vector<Index> neighbours, here;
  for (const Index row : {kVertex - kSide - 1, kVertex, kVertex + kSide + 1})
    for (const Index v : {row - 1, row, row + 1}) {
      if (v == kVertex) continue;
      neighbours.push_back(v);
      if (const Index mine = find_vertex(*part.input, v); mine != kNoIndex) here.push_back(mine);
    }
  Progress progress;
  parameters.fixed = neighbours;
  dmoscope::Run theirs(whole_input(mesh), parameters, std::make_shared<ThreadPool>(1), 0);
  parameters.fixed = here;
  dmoscope::Run mine(part.input, parameters, std::make_shared<ThreadPool>(1), 0);
  const Outcome want = theirs.until_converged({}, progress), got = mine.until_converged({}, progress);
  EXPECT_EQ(want.reason, StopReason::Certified) << want.sentence();
  EXPECT_EQ(got.reason, StopReason::Certified);
  EXPECT_EQ(got.iterations, want.iterations);
  expect_same_positions(part, mine, theirs);
}

/// A method that may make things worse goes back to its best iteration: also if a rank has nothing to visit, or no vertex at all.
TEST(SharedSmoothing, GoesBackToTheBestIterationTogether) {
  const World world;
  for (const char* method : {"laplace", "angle-based"})
    for (const Sample& sample : {Sample{"nine vertices", generated("grid", 9)}, Sample{"tangled", generated("tangled", 150)}}) {
      SCOPED_TRACE(sample.name);
      RunParameters parameters;
      parameters.method = method;
      parameters.backend = Backend::Cpu;
      const SharedMesh mesh = shared(world, sample.mesh);
      dmoscope::Run theirs(whole_input(sample.mesh), parameters, std::make_shared<ThreadPool>(1), 0);
      dmoscope::Run mine(mesh.input, parameters, std::make_shared<ThreadPool>(1), 0);
      Progress progress;
      for (dmoscope::Run* run : {&theirs, &mine}) {
        run->iterate(20, progress);
        run->end_at_best(progress);
      }
      EXPECT_EQ(mine.moment(), theirs.moment());
      expect_same_positions(mesh, mine, theirs);
    }
}

/// The inner square of nine, or of more, is turned by half a turn: no single vertex gains, and several are moved together.
TEST(SharedSmoothing, UntanglesSeveralVerticesTogether) {
  const World world;
  for (const Index side : {3U, 12U}) {
    Mesh mesh = lattice(side, 0.0, 1, Cells::Quadrilaterals);
    const Index corner = (side / 2) * (side + 2), above = corner + side + 1;
    std::swap(mesh.positions[corner], mesh.positions[above + 1]);
    std::swap(mesh.positions[corner + 1], mesh.positions[above]);
    compare(world, {"turned square", mesh}, {}, 8);
    compare(world, {"turned square, other numbers", shuffled_mesh(mesh, 5)}, {.metric = Metric::ScaledJacobian}, 8);
    RunParameters parameters;
    dmoscope::Run mine(shared(world, mesh).input, parameters, std::make_shared<ThreadPool>(1), 0);
    Progress progress;
    mine.iterate(8, progress);
    EXPECT_EQ(mine.history().records().back().statistics.inverted, 0U);
  }
}

/// A region with parts on several ranks is the same on all of them, and that of one process.
TEST(SharedSmoothing, ARegionIsTheSameForAll) {
  const World world;
  for (const Sample& sample : {Sample{"coast", generated("coast", 300)}, Sample{"solids", generated("solids", 150)}}) {
    SCOPED_TRACE(sample.name);
    const auto whole = whole_input(sample.mesh);
    const SharedMesh mesh = shared(world, sample.mesh);
    const auto around = [&](const InputMesh& input, std::uint64_t number) {
      std::vector<Index> seeds;
      for (Index e = 0; e < input.mesh.elements.size(); ++e)
        if ((input.share ? input.share->element_numbers()[e] : e) == number) seeds.push_back(e);
      const std::vector<std::uint8_t> fixed(input.topology.boundary().begin(), input.topology.boundary().end());
      return region_around(input, input.mesh.positions, fixed, seeds, 2, 1U << 20U);
    };
    for (const std::uint64_t number : {0U, 57U, 133U}) {
      const auto mine = around(*mesh.input, number), theirs = around(*whole, number);
      ASSERT_TRUE(mine && theirs);
      EXPECT_EQ(mine->vertices, theirs->vertices);
      EXPECT_EQ(mine->fixed, theirs->fixed);
      EXPECT_EQ(mine->rim, theirs->rim);
      EXPECT_TRUE(std::ranges::equal(mine->input->mesh.elements.all_corners(), theirs->input->mesh.elements.all_corners()));
      EXPECT_TRUE(same_bits(mine->input->mesh.positions, theirs->input->mesh.positions));
      EXPECT_FALSE(region_around(*whole, whole->mesh.positions, whole->topology.boundary(), {}, 2, 100)) << "nothing to look around";
    }
  }
}

TEST(SharedSmoothing, MayHaveMoreRanksThanVertices) {
  const World world;
  compare(world, {"nine vertices", generated("grid", 9)}, {}, 3);
  Mesh one;
  one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::array<Index, 3> corners{0, 1, 2};
  one.elements.add(ElementKind::Triangle, corners);
  compare(world, {"one triangle", one}, {}, 2);
}

}  // namespace
}  // namespace dmoscope::testing
