// Searches by the lanes of a team find the bits of one lane alone. A thread stands for each lane of a team.

#include <array>
#include <barrier>
#include <cstring>
#include <thread>

#include "gpu/bodies.h"
#include "tests/gpu/same_bits.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::gpu {
namespace {

using namespace testing;

constexpr unsigned kSize = 8;

/// Values that the lanes of a team exchange.
struct Board {
  std::barrier<> barrier{kSize};
  std::array<std::array<unsigned char, 64>, kSize> values;
};

class ThreadTeam {
 public:
  static constexpr unsigned kSize = gpu::kSize;
  ThreadTeam(Board& board, unsigned lane) : board_(&board), lane_(lane) {}
  [[nodiscard]] unsigned lane() const { return lane_; }
  template <class T>
  [[nodiscard]] T exchange(T value, unsigned mask) const {
    static_assert(sizeof(T) <= 64);
    std::memcpy(board_->values[lane_].data(), &value, sizeof(T));
    board_->barrier.arrive_and_wait();
    std::memcpy(&value, board_->values[lane_ ^ mask].data(), sizeof(T));
    board_->barrier.arrive_and_wait();
    return value;
  }

 private:
  Board* board_;
  unsigned lane_;
};

/// A mesh's stars as a kernel sees them, in the host's memory.
struct HostTask {
  Subject subject;
  StarTable table;
  std::vector<Vec3> ranked;
  Task task;

  explicit HostTask(std::shared_ptr<const InputMesh> input)
      : subject(std::move(input)), table(build_star_table(subject.input->mesh, subject.input->topology, *subject.colouring, nullptr)) {
    for (const Index v : table.vertex_of_rank) ranked.push_back(subject.input->mesh.positions[v]);
    task.shapes = table.shapes.data();
    task.others = table.others.data();
    task.mesh = subject.input->planar_view();
    task.rank_of_vertex = table.rank_of_vertex.data();
    task.vertex_of_rank = table.vertex_of_rank.data();
    task.ranked = ranked.data();
    task.frame = make_search_frame(*subject.input);
  }
};

bool same_step(const Displacement& a, const Displacement& b) {
  for (int i = 0; i < 3; ++i)
    if (!testing::same(a.target[i], b.target[i])) return false;
  return true;
}

/// Runs search(lane's team) on a thread per lane; returns the result of lane 0.
template <class Search>
auto with_team(Search search) {
  Board board;
  using Result = decltype(search(ThreadTeam(board, 0)));
  std::array<Result, kSize> results;
  {
    std::array<std::jthread, kSize> lanes;
    for (unsigned lane = 0; lane < kSize; ++lane)
      lanes[lane] = std::jthread([&, lane] { results[lane] = search(ThreadTeam(board, lane)); });
  }
  return results[0];
}

template <Metric M>
void expect_team_finds_the_same(const HostTask& host, const SearchParameters& parameters) {
  Task task = host.task;
  task.parameters = parameters;
  using Outcomes = std::vector<typename FastVisit<M, Solo, Stars::All, Task>::Outcome>;
  using TeamOutcomes = std::vector<typename FastVisit<M, ThreadTeam, Stars::All, Task>::Outcome>;
  const auto count = static_cast<Index>(host.subject.visits());
  Outcomes alone;
  for (Index rank = 0; rank < count; ++rank)
    alone.push_back(task.shapes[rank].kind == StarShape::Kind::Alone ? typename Outcomes::value_type{}
                                                                     : FastVisit<M, Solo, Stars::All, Task>(task, rank, Solo{}).run());
  const TeamOutcomes together = with_team([&](const ThreadTeam& team) {
    TeamOutcomes found;
    for (Index rank = 0; rank < count; ++rank)
      found.push_back(task.shapes[rank].kind == StarShape::Kind::Alone
                          ? typename TeamOutcomes::value_type{}
                          : FastVisit<M, ThreadTeam, Stars::All, Task>(task, rank, team).run());
    return found;
  });
  std::size_t moving = 0;
  for (Index rank = 0; rank < count; ++rank) {
    ASSERT_EQ(alone[rank].ready, together[rank].ready) << rank;
    ASSERT_EQ(static_cast<int>(alone[rank].verdict), static_cast<int>(together[rank].verdict)) << rank;
    ASSERT_TRUE(same_step(alone[rank].to, together[rank].to)) << rank;
    moving += alone[rank].verdict == visit_rules::Verdict::Move ? 1U : 0U;
  }
  EXPECT_GT(moving, count / 4) << "most of these meshes' vertices have somewhere to go";
}

/// The exact visit's target, for every vertex.
template <Metric M>
void expect_team_settles_the_same(const HostTask& host) {
  const PositionView positions = positions_of(host.task);
  const auto count = static_cast<Index>(host.subject.visits());
  const auto targets = [&](const auto& team) {
    std::vector<Vec2<double>> found;
    for (Index rank = 0; rank < count; ++rank) {
      const MeshStar<Plane> star(host.task.mesh, positions, host.task.vertex_of_rank[rank]);
      found.push_back(search_star<M>(star, star.box(), SearchParameters{}, Untangling{}, team));
    }
    return found;
  };
  const auto alone = targets(Solo{}), together = with_team([&](const ThreadTeam&team) { return targets(team); });
  for (Index rank = 0; rank < count; ++rank) {
    ASSERT_TRUE(testing::same(alone[rank].x, together[rank].x)) << rank;
    ASSERT_TRUE(testing::same(alone[rank].y, together[rank].y)) << rank;
  }
}

HostTask prepared(Mesh mesh) {
  Progress progress;
  return HostTask(prepare_input(std::move(mesh), {}, Need::Smoothing, progress));
}

TEST(Team, FindsWhatOneLaneFinds) {
  using dmoscope::testing::Cells;
  expect_team_finds_the_same<Metric::MeanRatio>(prepared(dmoscope::testing::lattice(9, 0.35, 61)), {});
  expect_team_finds_the_same<Metric::MeanRatio>(prepared(dmoscope::testing::wheels(1)), {});
  expect_team_finds_the_same<Metric::MeanRatio>(prepared(dmoscope::testing::lattice(6, 0.35, 62, Cells::Mixed)), {});
  expect_team_finds_the_same<Metric::MeanRatio>(prepared(dmoscope::testing::lattice(6, 0.35, 63)), {.grid_points = 5});
  expect_team_finds_the_same<Metric::MeanRatio>(prepared(dmoscope::testing::lattice(6, 0.35, 64)), {.grid_points = 19});
  expect_team_finds_the_same<Metric::MeanRatioArea>(prepared(dmoscope::testing::lattice(6, 0.35, 65, Cells::Quadrilaterals)), {});
  expect_team_finds_the_same<Metric::Rectangularity>(prepared(dmoscope::testing::lattice(6, 0.35, 66)), {});
}

/// Symmetric stars with candidates of equal quality, of which the one of lowest index must win.
TEST(Team, BreaksTiesAsOneLaneDoes) {
  const HostTask regular = prepared(dmoscope::testing::lattice(6, 0.0, 67));
  expect_team_settles_the_same<Metric::MeanRatio>(regular);
  Mesh mesh = dmoscope::testing::lattice(6, 0.0, 67);
  for (Vec3& p : mesh.positions) p = {std::round(8 * p.x) / 8 + (p.x > 2 && p.x < 3 ? 0.25 : 0.0), p.y, 0};
  expect_team_settles_the_same<Metric::MeanRatio>(prepared(std::move(mesh)));
}

TEST(Team, SettlesInvertedStarsAsOneLaneDoes) {
  expect_team_settles_the_same<Metric::MeanRatio>(prepared(dmoscope::testing::lattice(7, 0.9, 68)));
  expect_team_settles_the_same<Metric::ScaledJacobian>(prepared(dmoscope::testing::mixed_stars()));
}

/// Every lane has found an equal value, in another order: the lowest index wins, and an old best that none improves stays.
TEST(Team, TheLowestIndexWinsAmongEquals) {
  const auto best_of = [](int found_by) {
    return with_team([found_by](const ThreadTeam& team) {
      const int index = static_cast<int>(8 * (7 - team.lane()));
      const bool found = static_cast<int>(team.lane()) >= found_by;
      return best_of_team(team, Candidate<double>{{found ? 1.0 + index : 0.0, 0.0}, 0.5}, found ? index : -1).offset.x;
    });
  };
  EXPECT_EQ(best_of(0), 1.0);
  EXPECT_EQ(best_of(8), 0.0) << "none found more than there was";
}

}  // namespace
}  // namespace dmoscope::gpu
