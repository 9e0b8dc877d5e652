#include "core/smooth/methods/volume_dvr.h"

#include <cmath>

#include "core/mesh/random.h"
#include "core/smooth/methods/volume_line.h"
#include "core/smooth/vertex_rule.h"

namespace dmoscope {

namespace {

constexpr LineStretch kSpaceReach{-4.0,
                                  4.0};  // in units of the star's scale, in which its other vertices are less than 2 away along each axis

class VolumeDvr {
 public:
  struct Scratch {
    VolumeStar<double> star;
    std::vector<LineCorner> corners;
  };
  static constexpr bool kDependsOnIteration = true;
  explicit VolumeDvr(const SmoothingTask& task) : mesh_(*task.input), options_(task.options) {}

  void begin(const Sweep& sweep) {
    direction_ = volume_dvr_direction(options_, sweep.iteration);
    mesh_.untangling = sweep.untangling;
  }

  std::optional<Vec3> target(PositionView positions, Index vertex, Scratch& scratch) const {
    gather_star(MeshStar(mesh_.view, positions, vertex), scratch.star);
    corners_on_line(scratch.star, direction_, scratch.corners);
    const double t = best_on_line(scratch.corners);
    if (t == 0.0) return std::nullopt;
    return mesh_.moved_if_gaining<Metric::MeanRatio>(positions, vertex, times(direction_, t), scratch.star.scale);
  }

 private:
  /// The best place on the line. A star with inverted elements goes where none is inverted; if there is no such place, where DMO's measure
  /// of inversion is best.
  static double best_on_line(std::span<const LineCorner> corners) {
    if (least_jacobian(corners, 0.0) > 0.0 || least_jacobian(corners, best_jacobian(corners, kSpaceReach)) > 0.0)
      return best_rank(corners, kSpaceReach);
    return best_untangling(corners, kSpaceReach);
  }

  RuleMesh<Space> mesh_;
  MethodOptions options_;
  Vec3 direction_;
};

}  // namespace

Vec3 volume_dvr_direction(const MethodOptions& options, std::uint64_t iteration) {
  if (options.directions == Directions::Axes) {
    constexpr Vec3 kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return kAxes[iteration % 3];
  }
  Random random(Random(options.seed).next() + iteration);
  while (true) {  // from a shell around 0, so that no direction is likelier than another
    const Vec3 p{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const double square = dot(p, p);
    if (square > 0.01 && square <= 1.0) return times(p, 1.0 / std::sqrt(square));
  }
}

std::unique_ptr<Smoother> make_volume_dvr_smoother(const SmoothingTask& task) { return make_rule_smoother(task, VolumeDvr(task)); }

}  // namespace dmoscope
