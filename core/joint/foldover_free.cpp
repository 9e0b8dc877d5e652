#include "core/joint/foldover_free.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/joint/determinant_samples.h"
#include "core/joint/element_blocks.h"
#include "core/joint/mean_ratio_atom.h"
#include "core/quality/validity.h"

namespace dmoscope {

namespace {

constexpr std::size_t kAtOnce = 1024, kGrain = 32;  // numbers of elements
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeastEpsilon = 1e-9;
constexpr double kLeastFall = 0.3;  // relative fall of chi of the least J, in a step
constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-6, kMostDamping = 1e6;
constexpr double kStronger = 16.0, kMostShortened = 1e3;  // damping where something slides and no step succeeds
constexpr double kHopeless = 0.02;  // share of the least J: where epsilon is below it, inverted elements are behind the wall and stay there
constexpr int kAfterwards = 4;      // steps that are taken when nothing is inverted any more, for better shapes

/// Wall chi and its derivatives by J.
struct Wall {
  Wall(double j, double epsilon) {
    const double root = std::sqrt(epsilon * epsilon + j * j);
    value = j > 0.0 ? 0.5 * (j + root) : 0.5 * epsilon * epsilon / (root - j);  // without cancellation
    first = value / root;
    second = 0.5 * epsilon * epsilon / (root * root * root);
  }
  double value, first, second;
};

template <int D>
double root_of(double size) {
  if constexpr (D == 2)
    return std::sqrt(size);
  else
    return scalar::cube_root(size);
}

template <int D>
class FoldoverFree {
  static constexpr std::size_t kD = D;
  using Place = std::array<double, kD>;
  using Places = std::vector<Place>;
  using Corners = std::array<Place, 8>;
  using Element = typename FoldoverFreeProblem<D>::Element;
  using Sample = DeterminantSample<D>;
  using Matrix = MatrixOfColumns<D>;
  using Derivatives = typename ElementBlocks<D>::Derivatives;

 public:
  FoldoverFree(const FoldoverFreeProblem<D>& problem, const FoldoverFreeOptions& options)
      : problem_(problem), options_(options), system_(problem, options.pool), unit_(1.0 / root_of<D>(problem.size)) {
    for (std::size_t e = 0; e < problem.elements.size(); ++e) watched_.push_back(corners_that_move(e));
  }
  FoldoverFreeSolution<D> solve(const std::function<void(const FoldoverFreeIterate<D>&)>& on_step, Progress& progress);

 private:
  /// Measures of a set of displacements that do not depend on epsilon.
  struct Standing {
    std::size_t inverted = 0;
    double least = kInfinity;           // see FoldoverFreeIterate
    double least_jacobian = kInfinity;  // least determinant watched, against the size
    std::vector<std::size_t> inside{};  // elements that are sound at their corners and not proved to be so inside
  };
  /// Samples of an element that are watched: bits of its corner samples, and of its inner ones behind them.
  struct Watch {
    std::uint32_t bits = 0;
    bool is_lost = false;  // a corner that cannot move is inverted
  };

  [[nodiscard]] bool moves(const Element& element, const Sample& sample) const {
    return std::any_of(sample.corners.begin(), sample.corners.begin() + sample.count,
                       [&](std::uint8_t k) { return element.vertices[k] < problem_.free_vertices; });
  }
  [[nodiscard]] Watch corners_that_move(std::size_t element) const;
  void watch_inside(std::size_t element);
  /// Calls a body for each sample of an element that is watched.
  template <class Body>
  void for_watched(std::size_t element, const Body& body) const {
    const ElementKind kind = problem_.elements[element].kind;
    const std::span<const Sample> corners = corner_samples<D>(kind), inner = inner_samples<D>(kind);
    std::uint32_t bits = watched_[element].bits;
    for (std::size_t s = 0; bits != 0; ++s, bits >>= 1U)
      if ((bits & 1U) != 0) body(s < corners.size() ? corners[s] : inner[s - corners.size()], s < corners.size());
  }
  [[nodiscard]] Corners corners(std::size_t element, const Places& displacements) const;
  /// Matrix T in a unit in which the size is 1.
  [[nodiscard]] Matrix matrix(const Sample& sample, const Corners& corners) const;
  [[nodiscard]] bool proved_inside(std::size_t element, const Corners& corners) const;
  [[nodiscard]] Standing stand(const Places& displacements) const;
  [[nodiscard]] double energy(const Places& displacements) const;
  void derive(std::size_t element, const Corners& corners, Derivatives& result) const;
  void derive_springs(std::size_t element, const Corners& corners, Derivatives& result) const;
  template <class Derive>
  void weighted(std::size_t element, const Derive& derive_one, Derivatives& result) const;
  template <class Derive>
  void assemble(const Derive& derive_one);
  void assemble() {
    assemble([this](std::size_t e, const Corners& at, Derivatives& result) { derive(e, at, result); });
  }
  void spring();
  [[nodiscard]] bool find_direction();
  [[nodiscard]] bool step();
  [[nodiscard]] bool go(double share);
  void lower_epsilon(double least_jacobian, double fall);

  const FoldoverFreeProblem<D>& problem_;
  const FoldoverFreeOptions& options_;
  ElementBlocks<D> system_;
  double unit_;
  std::vector<Watch> watched_;
  Places at_, trial_;
  std::vector<double> direction_;
  std::vector<Derivatives> derivatives_;  // derivatives of a batch of elements
  double epsilon_ = 1.0, energy_ = 0.0, fall_ = 0.0, damping_ = kFirstDamping, alpha_ = 1.0;
};

// ---- samples to watch ----

template <int D>
typename FoldoverFree<D>::Watch FoldoverFree<D>::corners_that_move(std::size_t index) const {
  const Element& element = problem_.elements[index];
  const auto samples = corner_samples<D>(element.kind);
  Watch watch;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    if (moves(element, samples[s]))
      watch.bits |= 1U << s;
    else
      watch.is_lost = watch.is_lost || !(matrix(samples[s], element.corners).determinant > 0.0);
  }
  return watch;
}

template <int D>
void FoldoverFree<D>::watch_inside(std::size_t index) {
  const Element& element = problem_.elements[index];
  const auto samples = inner_samples<D>(element.kind);
  const std::size_t first = corner_samples<D>(element.kind).size();
  for (std::size_t s = 0; s < samples.size(); ++s)
    if (moves(element, samples[s])) watched_[index].bits |= 1U << (first + s);
}

template <int D>
typename FoldoverFree<D>::Corners FoldoverFree<D>::corners(std::size_t index, const Places& displacements) const {
  const Element& element = problem_.elements[index];
  Corners result = element.corners;
  for (std::size_t k = 0; k < info(element.kind).corners; ++k)
    if (const Index v = element.vertices[k]; v < problem_.free_vertices)
      for (std::size_t r = 0; r < kD; ++r) result[k][r] += displacements[v][r];
  return result;
}

template <int D>
typename FoldoverFree<D>::Matrix FoldoverFree<D>::matrix(const Sample& sample, const Corners& corners) const {
  Matrix result;
  for (std::size_t i = 0; i < sample.count; ++i) {
    const Place& corner = corners[sample.corners[i]];
    for (std::size_t c = 0; c < kD; ++c)
      for (std::size_t r = 0; r < kD; ++r) result.column[c][r] += sample.slopes[i][c] * corner[r];
  }
  for (auto& column : result.column)
    for (double& x : column) x *= unit_;
  result.measure();
  return result;
}

template <int D>
bool FoldoverFree<D>::proved_inside(std::size_t index, const Corners& corners) const {
  if constexpr (D == 3) {
    const auto proved = [&]<std::size_t N>(auto shape, std::array<Vec3, N>& at) {
      for (std::size_t k = 0; k < N; ++k) at[k] = {corners[k][0], corners[k][1], corners[k][2]};
      shape.at = at;
      return validity_of(shape).proved;
    };
    if (problem_.elements[index].kind == ElementKind::Hexahedron) {
      std::array<Vec3, 8> at{};
      return proved(formulas::Hexahedron<Vec3>{}, at);
    }
    if (problem_.elements[index].kind == ElementKind::Wedge) {
      std::array<Vec3, 6> at{};
      return proved(formulas::Wedge<Vec3>{}, at);
    }
  }
  return true;
}

template <int D>
typename FoldoverFree<D>::Standing FoldoverFree<D>::stand(const Places& displacements) const {
  std::vector<Standing> parts((problem_.elements.size() + kGrain - 1) / kGrain);
  for_chunks(options_.pool, problem_.elements.size(), kGrain, [&](std::size_t first, std::size_t last) {
    Standing& part = parts[first / kGrain];
    for (std::size_t e = first; e < last; ++e) {
      const Corners at = corners(e, displacements);
      bool sound = true;
      for_watched(e, [&](const Sample& sample, bool is_corner) {
        const Matrix t = matrix(sample, at);
        sound = sound && (!is_corner || t.determinant > 0.0);
        part.least_jacobian = std::min(part.least_jacobian, t.determinant);
        if (is_corner) part.least = std::min(part.least, t.square > 0.0 ? inverse_norm_power<D>(t.square) * t.determinant : 0.0);
      });
      if (sound && !watched_[e].is_lost && !proved_inside(e, at)) {
        part.inside.push_back(e);
        sound = false;
      }
      part.inverted += sound ? 0 : 1;
    }
  });
  Standing result;
  for (const Standing& part : parts) {
    result.inverted += part.inverted;
    result.least = std::min(result.least, part.least);
    result.least_jacobian = std::min(result.least_jacobian, part.least_jacobian);
    result.inside.insert(result.inside.end(), part.inside.begin(), part.inside.end());
  }
  return result;
}

// ---- the energy ----

template <int D>
double FoldoverFree<D>::energy(const Places& displacements) const {
  std::vector<double> parts((problem_.elements.size() + kGrain - 1) / kGrain, 0.0);
  for_chunks(options_.pool, problem_.elements.size(), kGrain, [&](std::size_t first, std::size_t last) {
    double& sum = parts[first / kGrain];
    for (std::size_t e = first; e < last; ++e) {
      const Corners at = corners(e, displacements);
      for_watched(e, [&](const Sample& sample, bool) {
        const Matrix t = matrix(sample, at);
        const double j = t.determinant, chi = Wall(j, epsilon_).value;
        sum += problem_.elements[e].weight * (t.square / (D * scale_of<D>(chi)) + options_.theta * (j * j + 1.0) / chi);
      });
    }
  });
  double sum = 0.0;
  for (const double part : parts) sum += part;
  return sum;
}

/// Derivatives of an element's energy. The Hessian takes J as linear in the vertices, and chi as linear in J in the term of shapes:
/// positive semidefinite.
template <int D>
void FoldoverFree<D>::derive(std::size_t index, const Corners& at, Derivatives& result) const {
  result = {};
  for_watched(index, [&](const Sample& sample, bool) {
    const Matrix t = matrix(sample, at);
    const double j = t.determinant, p = 2.0 / D, theta = options_.theta;
    const Wall chi(j, epsilon_);
    const double s = 1.0 / scale_of<D>(chi.value), shape = t.square / D * s, steep = chi.first / chi.value;
    const double size = (j * j + 1.0) / chi.value;
    const double by_j = -p * shape * steep + theta * (2.0 * j / chi.value - size * steep);
    const double bend = theta * (2.0 / chi.value - 4.0 * j / chi.value * steep + size * (2.0 * steep * steep - chi.second / chi.value));
    const double twice = p * (p + 1.0) * shape * steep * steep + std::max(0.0, bend), both = -p * (2.0 / D) * s * steep;
    std::array<Place, 8> by_square{}, by_determinant{};  // derivatives of half the square, and of J, by the corners
    for (std::size_t i = 0; i < sample.count; ++i) {
      for (std::size_t c = 0; c < kD; ++c)
        for (std::size_t r = 0; r < kD; ++r) {
          by_square[i][r] += unit_ * sample.slopes[i][c] * t.column[c][r];
          by_determinant[i][r] += unit_ * sample.slopes[i][c] * t.cofactor[c][r];
        }
      for (std::size_t r = 0; r < kD; ++r)
        result.gradient[sample.corners[i]][r] += 2.0 / D * s * by_square[i][r] + by_j * by_determinant[i][r];
    }
    for (std::size_t i = 0; i < sample.count; ++i)
      for (std::size_t m = 0; m < sample.count; ++m) {
        const std::size_t k = sample.corners[i], l = sample.corners[m];
        if (l > k) continue;
        double slopes = 0.0;
        for (std::size_t c = 0; c < kD; ++c) slopes += sample.slopes[i][c] * sample.slopes[m][c];
        auto& block = result.hessian[k * (k + 1) / 2 + l];
        for (std::size_t r = 0; r < kD; ++r) {
          for (std::size_t c = 0; c < kD; ++c)
            block[r * kD + c] += both * (by_square[i][r] * by_determinant[m][c] + by_determinant[i][r] * by_square[m][c]) +
                                 twice * (by_determinant[i][r] * by_determinant[m][c]);
          block[r * kD + r] += 2.0 / D * s * unit_ * unit_ * slopes;
        }
      }
  });
}

/// Derivatives of half the sum of |T|^2.
template <int D>
void FoldoverFree<D>::derive_springs(std::size_t index, const Corners& at, Derivatives& result) const {
  result = {};
  for_watched(index, [&](const Sample& sample, bool) {
    const Matrix t = matrix(sample, at);
    for (std::size_t i = 0; i < sample.count; ++i) {
      for (std::size_t c = 0; c < kD; ++c)
        for (std::size_t r = 0; r < kD; ++r) result.gradient[sample.corners[i]][r] += unit_ * sample.slopes[i][c] * t.column[c][r];
      for (std::size_t m = 0; m < sample.count; ++m) {
        const std::size_t k = sample.corners[i], l = sample.corners[m];
        if (l > k) continue;
        double slopes = 0.0;
        for (std::size_t c = 0; c < kD; ++c) slopes += sample.slopes[i][c] * sample.slopes[m][c];
        for (std::size_t r = 0; r < kD; ++r) result.hessian[k * (k + 1) / 2 + l][r * kD + r] += unit_ * unit_ * slopes;
      }
    }
  });
}

/// Derivatives of an element times its weight.
template <int D>
template <class Derive>
void FoldoverFree<D>::weighted(std::size_t element, const Derive& derive_one, Derivatives& result) const {
  derive_one(element, corners(element, at_), result);
  const double weight = problem_.elements[element].weight;
  if (weight == 1.0) return;
  for (auto& gradient : result.gradient)
    for (double& x : gradient) x *= weight;
  for (auto& block : result.hessian)
    for (double& x : block) x *= weight;
}

template <int D>
template <class Derive>
void FoldoverFree<D>::assemble(const Derive& derive_one) {
  system_.clear();
  const std::size_t count = problem_.elements.size();
  derivatives_.resize(std::min(kAtOnce, count));
  for (std::size_t begin = 0; begin < count; begin += kAtOnce) {
    const std::size_t size = std::min(kAtOnce, count - begin);
    for_chunks(options_.pool, size, kGrain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) weighted(begin + i, derive_one, derivatives_[i]);
    });
    for (std::size_t i = 0; i < size; ++i) system_.add(begin + i, derivatives_[i]);
  }
}

// ---- steps ----

/// Moves the vertices to where springs along all edges balance.
template <int D>
void FoldoverFree<D>::spring() {
  const auto derive_one = [this](std::size_t e, const Corners& at, Derivatives& result) { derive_springs(e, at, result); };
  assemble(derive_one);
  if (problem_.path != nullptr) {
    std::vector<double> forces = system_.gradient();
    for (double& x : forces) x = -x;
    problem_.path->choose(forces);
    assemble(derive_one);
  }
  if (system_.solve(0.0, direction_) && go(1.0)) at_.swap(trial_);
  if (problem_.path != nullptr) problem_.path->take();
}

/// Finds Newton's direction, with more and more of the diagonal added where the matrix is singular.
template <int D>
bool FoldoverFree<D>::find_direction() {
  if (problem_.path != nullptr) {
    assemble();
    std::vector<double> forces = system_.gradient();
    for (double& x : forces) x = -x;
    problem_.path->choose(forces);
  }
  for (; damping_ <= kMostDamping; damping_ *= 10.0) {
    assemble();
    if (system_.solve(damping_, direction_)) return true;
  }
  return false;
}

/// Tries a share of the direction. False: the trial is impossible.
template <int D>
bool FoldoverFree<D>::go(double share) {
  for (std::size_t v = 0; v < at_.size(); ++v)
    for (std::size_t r = 0; r < kD; ++r) trial_[v][r] = at_[v][r] + share * direction_[v * kD + r];
  return problem_.path == nullptr || problem_.path->put_back(at_, trial_);
}

template <int D>
bool FoldoverFree<D>::step() {
  if (!find_direction()) return false;
  double slope = 0.0;
  for (std::size_t i = 0; i < direction_.size(); ++i) slope += direction_[i] * system_.gradient()[i];
  if (!(slope < 0.0)) return false;
  alpha_ = 1.0;
  const int attempts = problem_.path == nullptr ? 30 : 8;
  for (int attempt = 0; attempt < attempts; ++attempt, alpha_ *= 0.6) {
    if (!go(alpha_)) continue;
    const double there = energy(trial_);
    if (!(there <= energy_ + 1e-4 * alpha_ * slope)) continue;
    fall_ = 1.0 - there / energy_;
    energy_ = there;
    at_.swap(trial_);
    if (problem_.path != nullptr) problem_.path->take();
    return true;
  }
  return false;
}

/// Lowers epsilon as far as the energy's last fall allows that its next minimum is no higher: the paper's theorem 2.
template <int D>
void FoldoverFree<D>::lower_epsilon(double j, double fall) {
  const double mu = (1.0 - std::max(kLeastFall, fall)) * Wall(j, epsilon_).value;
  epsilon_ = j < mu ? std::min(epsilon_, 2.0 * std::sqrt(mu * (mu - j))) : kLeastEpsilon;
  epsilon_ = std::max(epsilon_, kLeastEpsilon);
}

template <int D>
FoldoverFreeSolution<D> FoldoverFree<D>::solve(const std::function<void(const FoldoverFreeIterate<D>&)>& on_step, Progress& progress) {
  FoldoverFreeSolution<D> solution;
  solution.best.assign(problem_.free_vertices, Place{});
  Standing now = stand(solution.best);
  solution.start_inverted = solution.inverted = now.inverted;
  solution.start_least = solution.least = now.least;
  at_ = trial_ = solution.best;
  if (now.inverted == 0) return solution;
  const auto keep = [&] {
    if (now.least < solution.start_least || now.inverted > solution.inverted) return;
    if (now.inverted == solution.inverted && now.least <= solution.least) return;
    solution.best = at_;
    solution.inverted = now.inverted;
    solution.least = now.least;
    if (problem_.path != nullptr) problem_.path->keep_best();
  };
  if (options_.springs_first) {
    spring();
    now = stand(at_);
    keep();
  }
  for (const std::size_t e : now.inside) watch_inside(e);
  if (!now.inside.empty()) now = stand(at_);
  epsilon_ = now.least_jacobian > 0.0 ? 1e-3 : std::sqrt(1e-6 + 0.04 * now.least_jacobian * now.least_jacobian);
  energy_ = energy(at_);
  for (int afterwards = 0; solution.steps < options_.max_steps && afterwards <= kAfterwards;) {
    progress.check();
    if (!step()) {  // sliding vertices may go less far than asked: smaller steps may do
      if (problem_.path == nullptr || damping_ >= kMostShortened) break;
      damping_ = kStronger * std::max(damping_, kFirstDamping);
      continue;
    }
    ++solution.steps;
    damping_ = alpha_ > 0.7 ? std::max(damping_ / 4.0, kLeastDamping) : alpha_ < 0.3 ? 4.0 * damping_ : damping_;
    now = stand(at_);
    keep();
    if (on_step) on_step({at_, solution.steps, now.inverted, now.least});
    if (now.inverted == 0) ++afterwards;
    if (epsilon_ < kHopeless * -now.least_jacobian) break;
    lower_epsilon(now.least_jacobian, fall_);
    for (const std::size_t e : now.inside) watch_inside(e);
    energy_ = energy(at_);
    if (!std::isfinite(energy_)) break;
  }
  return solution;
}

}  // namespace

template <int D>
FoldoverFreeSolution<D> solve_foldover_free(const FoldoverFreeProblem<D>& problem, const FoldoverFreeOptions& options,
                                            const std::function<void(const FoldoverFreeIterate<D>&)>& on_step, Progress& progress) {
  return FoldoverFree<D>(problem, options).solve(on_step, progress);
}

template FoldoverFreeSolution<2> solve_foldover_free<2>(const FoldoverFreeProblem<2>&, const FoldoverFreeOptions&,
                                                        const std::function<void(const FoldoverFreeIterate<2>&)>&, Progress&);
template FoldoverFreeSolution<3> solve_foldover_free<3>(const FoldoverFreeProblem<3>&, const FoldoverFreeOptions&,
                                                        const std::function<void(const FoldoverFreeIterate<3>&)>&, Progress&);

}  // namespace dmoscope
