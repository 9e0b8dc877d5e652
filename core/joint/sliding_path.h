#pragma once
// Vertices of a cluster that slide along curves and on surfaces of the input while it moves jointly.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/joint/face_watch.h"
#include "core/joint/joint_mesh.h"
#include "core/joint/joint_ways.h"
#include "core/joint/surface_sliders.h"
#include "core/reference/deviation_bound.h"

namespace dmoscope {

/// Vertices go along their curves, at most up to their neighbours, and only as far as the bound of deviation lets the edges beside them. At
/// a corner of a curve where a force holds a vertex from both sides it stops; the next step takes the side to which its force points, if
/// there is one. On a surface a vertex goes in the plane that touches it, and then down to it, across no feature edge, and the faces around
/// keep near the input as the edges do. All arguments must outlive it but `positions`, those of the cluster at the begin.
template <int D>
class SlidingPath final : public JointWays<D> {
 public:
  using typename JointWays<D>::Place;
  using typename JointWays<D>::Way;

  SlidingPath(const JointMesh<D>& mesh, const LocalProblem<D>& local, std::span<const Vec3> positions, const Domain& domain,
              const DeviationBound& limit);
  /// Returns whether a vertex of the cluster slides.
  [[nodiscard]] bool any() const noexcept { return any_; }

  /// Makes all sliders keep their places from now on. Only before the search begins.
  void hold();

  [[nodiscard]] std::span<const Way> ways() const noexcept override { return ways_; }
  [[nodiscard]] std::span<const std::uint8_t> bound() const noexcept override { return bound_; }
  void choose(std::span<const double> forces) override;
  [[nodiscard]] bool put_back(const std::vector<Place>& from, std::vector<Place>& trial) override;
  void take() override;
  void keep_best() override;

  /// Sets the targets of the vertices that slide, a share of their way to the best place: as the file would hold them, and by the rules for
  /// all that slide. Those that may not go there keep their place. Returns how many. `targets`: those of the cluster's vertices `free`, of
  /// which all that do not slide are known. `positions`: those of the mesh, unchanged at the end.
  [[nodiscard]] std::size_t settle(double share, std::span<const Index> free, std::span<Vec3> positions, std::span<Vec3> targets);
  /// Vertices of the mesh that the bound of deviation, or on a surface a feature edge, keeps from where their forces draw them, as choose()
  /// found them last; ascending.
  [[nodiscard]] std::vector<Index> stopped() const;

 private:
  static constexpr std::size_t kD = D, kNone = static_cast<std::size_t>(-1);
  /// Place of a vertex on its curve, and how far it has come, forwards, since the begin.
  struct Stand {
    double place = 0.0, gone = 0.0;
    Vec3 position{};
  };
  struct Slider {
    Index free, vertex;  // its number in the problem, and in the mesh
    Vec3 begin;
    double begin_place;
    Stand now, trial, best;
    std::size_t before = kNone, after = kNone;  // edges beside it
    Place way{};                                // direction in which it goes
    bool runs_forwards = true, one_sided = false, stopped = false;
    Place force{};
    double asked = 0.0;  // distance that the trial would lead it
  };
  /// Edge along a curve; an end that is no slider stays.
  struct Edge {
    std::size_t from = kNone, to = kNone;
    double place_from, gap;  // places at the begin
    Vec3 at_from, at_to;
    double limit = 0.0;  // limit of its deviation
  };

  void add_slider(Index free, Index vertex, Vec3 position);
  void add_edges(std::size_t slider, std::span<const Vec3> positions, std::span<const std::size_t> slider_of);
  [[nodiscard]] static Way free_way();
  void add_surface_slider(Index free, Index vertex, Vec3 position);
  void choose_on_surface(SurfaceSlider& slider, Vec3 force);
  void shorten();
  [[nodiscard]] std::vector<std::uint8_t> find_strayed();
  void shorten_marked(const std::vector<std::uint8_t>& marked, bool all);
  void walk(Slider& slider, double length) const;
  [[nodiscard]] bool draws_back(const Slider& slider, Vec3 way, Vec3 next) const;
  [[nodiscard]] double deviation(const Edge& edge, Index vertex, const Stand& from, const Stand& to) const;
  [[nodiscard]] bool keeps(const Edge& edge) const;
  [[nodiscard]] bool is_open(const Slider& slider, bool forwards);
  [[nodiscard]] bool edge_allows(const Edge& edge, std::size_t moved, const Stand& there) const;
  [[nodiscard]] Stand stand_at(const Slider& slider, double gone) const;
  [[nodiscard]] bool may_stand(const Slider& slider, std::span<const Vec3> positions) const;
  [[nodiscard]] Vec3 as_stored(const Slider& slider, const Stand& stand) const;
  [[nodiscard]] bool may_stand(const SurfaceSlider& slider, Vec3 position);
  [[nodiscard]] std::optional<Vec3> target(const SurfaceSlider& slider, double share) const;
  [[nodiscard]] double place_within(Index vertex, double place) const;

  const JointMesh<D>& mesh_;
  const Domain& domain_;
  const Curves& curves_;
  const DeviationBound& limit_;
  double scale_;
  bool any_ = false;
  std::vector<Way> ways_;
  std::vector<std::uint8_t> bound_;
  std::vector<Slider> sliders_;
  std::vector<Edge> edges_;
  std::vector<SurfaceSlider> on_surface_;
  std::unique_ptr<FaceWatch> faces_;  // null: there are none
  std::vector<std::uint8_t> unsure_;  // by slider, in a trial: whether its faces must be looked at
  std::vector<Index> of_vertex_;      // by vertex, where there are faces: its number among the sliders, first those on curves
};

}  // namespace dmoscope
