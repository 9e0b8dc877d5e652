#pragma once
// Properties of any sliding on a surface, measured by plain geometry against the input's faces.

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/smooth/execution/method_table.h"
#include "tests/smooth/sliding.h"
#include "tests/support/plain_surface.h"

namespace dmoscope::testing {

/// Moves the vertices on the sides of a block over the unit cube within these, and those on its edges along these.
inline Mesh shaken(Mesh mesh, double most, std::uint64_t seed) {
  dmoscope::testing::Random random(seed);
  for (Vec3& p : mesh.positions) {
    const bool at_side = p.x == 0 || p.x == 1 || p.y == 0 || p.y == 1 || p.z == 0 || p.z == 1;
    for (double* x : {&p.x, &p.y, &p.z})
      if (at_side && *x != 0.0 && *x != 1.0) *x += random(-most, most);
  }
  return mesh;
}

inline Vec3 ball(Vec3 p) {  // the cube's surface becomes a sphere's
  const Vec3 q = 2.0 * p - Vec3{1, 1, 1};
  const double most = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}), size = length(q);
  return size > 0.0 ? (most / size) * q : q;
}

/// The surface of the input, and the limits of the present one.
class SurfaceJudge {
 public:
  SurfaceJudge(const Specimen& specimen, const InputMesh& mesh, double max_deviation)
      : name_(specimen.name), mesh_(mesh), faces_(surface_faces(mesh.mesh)), before_(mesh.mesh.positions) {
    facets_ = triangles_of(faces_, before_);
    double far = 0.0;
    for (const Vec3& p : before_) far = std::max({far, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    tolerance_ = mesh.mesh.single_precision ? 4e-7 * std::max(far, mesh.geometry.size) : std::max(4e-12 * mesh.geometry.size, 4e-16 * far);
    is_folded_ = folds_back();
    bound_ = max_deviation * mesh.geometry.size + tolerance_;
  }

  /// Expects vertices on the surface and faces near it. `rough`: the surface is, so that parts of the input between faces that do not meet
  /// edge to edge as seen from it may be farther away.
  void expect_kept(const dmoscope::Run& run, bool rough = false) const {
    const std::span<const Vec3> now = run.positions();
    for (Index v = 0; v < now.size(); ++v) {
      if (mesh_.is_volume() && mesh_.topology.boundary()[v] == 0) continue;
      if (mesh_.topology.star(v).empty()) continue;
      ASSERT_LE(distance_to(now[v], before_, facets_), tolerance_) << name_ << ": vertex " << v << " left the surface";
      if (run.domain()->on_surface(v)) {
        ASSERT_TRUE(run.domain()->faces().place(v, now[v])) << name_ << ": vertex " << v << " is not found again";
      }
      if (run.domain()->slides(v)) continue;
      ASSERT_TRUE(same_bits(now.subspan(v, 1), before_.subspan(v, 1))) << name_ << ": corner " << v;
    }
    const std::vector<Triangle> present = triangles_of(faces_, now);
    ASSERT_LE(deviation(now, present, before_, facets_), bound_) << name_ << ": out of the input";
    if (!rough) {
      ASSERT_LE(deviation(before_, facets_, now, present), bound_) << name_ << ": the input out of it";
    }
    if (!is_folded_) {
      ASSERT_LE(folds(now), folds(before_)) << name_ << ": faces fold over";
    }
  }

 private:
  /// Number of faces whose middle does not look the same way as the input's nearest face; an input may have some itself.
  [[nodiscard]] std::size_t folds(std::span<const Vec3> now) const {
    std::size_t count = 0;
    for (const auto& f : faces_) {
      const Vec3 area =
          f.size() == 3 ? cross(now[f[1]] - now[f[0]], now[f[2]] - now[f[0]]) : cross(now[f[2]] - now[f[0]], now[f[3]] - now[f[1]]);
      const Vec3 middle = (1.0 / 3.0) * (now[f[0]] + now[f[1]] + now[f[2]]);
      double least = std::numeric_limits<double>::infinity(), cosine = -1.0;
      for (const auto& [a, b, c] : facets_) {
        const double far = distance_to_triangle(middle, before_[a], before_[b], before_[c]);
        if (far > least + tolerance_) continue;
        const double here = dot(unit(area), unit(cross(before_[b] - before_[a], before_[c] - before_[a])));
        cosine = far < least - tolerance_ ? here : std::max(cosine, here);
        least = std::min(least, far);
      }
      count += cosine > 0.0 ? 0 : 1;
    }
    return count;
  }

  /// Whether the input folds back on itself along an edge, so that the facet nearest to a point may be one of another sheet.
  [[nodiscard]] bool folds_back() const {
    std::map<std::pair<Index, Index>, Vec3> normals;  // by the edge in one face's direction
    for (const auto& [a, b, c] : facets_)
      for (const auto& [from, to] : {std::pair(a, b), {b, c}, {c, a}})
        normals[{from, to}] = unit(cross(before_[b] - before_[a], before_[c] - before_[a]));
    return std::ranges::any_of(normals, [&](const auto& one) {
      const auto other = normals.find({one.first.second, one.first.first});
      return other != normals.end() && dot(one.second, other->second) < -0.1;
    });
  }

  std::string name_;
  const InputMesh& mesh_;
  std::vector<std::vector<Index>> faces_;
  std::span<const Vec3> before_;
  std::vector<Triangle> facets_;
  double tolerance_, bound_;
  bool is_folded_;
};

/// Expects a method to keep vertices on the surface, and faces near it; those that optimise worsen no star. Uses some of the meshes, by a
/// method other than dmo; returns how many vertices slid.
inline std::size_t expect_kept_by(const char* method, const std::vector<Specimen>& all, std::size_t step, std::uint64_t iterations) {
  std::size_t moved = 0;
  for (std::size_t i = 0; i < all.size(); i += step) {
    const auto mesh = input(all[i].mesh);
    const SurfaceJudge judge(all[i], *mesh, 1e-3);
    RunParameters parameters = sliding_by();
    parameters.method = method;
    dmoscope::Run run = make_run(mesh, parameters);
    for (std::uint64_t iteration = 1; iteration <= iterations; ++iteration) {
      expect_promise_one_if(method_info(method).optimises, all[i], run, iteration);
      judge.expect_kept(run);
      expect_in_order(all[i], run);
      expect_fixed_stay(all[i], run);
      if (::testing::Test::HasFatalFailure()) return moved;
    }
    moved += slid(run);
  }
  return moved;
}

}  // namespace dmoscope::testing
