#include "core/joint/foldover_free.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/joint/atom_blocks.h"
#include "core/joint/mean_ratio_atom.h"

namespace dmoscope {

namespace {

constexpr double kLeastEpsilon = 1e-9;
constexpr double kLeastFall = 0.3;      // of chi of the least J, in a step
constexpr double kOntoDiagonal = 1e-9;  // what rounding could take from it
constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-6, kMostDamping = 1e6;
constexpr double kHopeless = 0.02;  // of the least J: where epsilon is below that, what is inverted is behind the wall and stays there
constexpr int kAfterwards = 4;      // steps that are taken when nothing is inverted any more, for better shapes

/// chi and its derivatives by J.
struct Wall {
  Wall(double j, double epsilon) {
    const double root = std::sqrt(epsilon * epsilon + j * j);
    value = j > 0.0 ? 0.5 * (j + root) : 0.5 * epsilon * epsilon / (root - j);  // without cancellation
    first = value / root;
    second = 0.5 * epsilon * epsilon / (root * root * root);
  }
  double value, first, second;
};

/// chi^(2 / D).
template <int D>
double power_of(double chi) {
  return scale_of<D>(chi);
}

template <int D>
class FoldoverFree {
  static constexpr std::size_t kD = D, kEdges = kD * kD;
  using Place = std::array<double, kD>;

 public:
  FoldoverFree(const JointProblem<D>& problem, const FoldoverFreeOptions& options)
      : problem_(problem), options_(options), system_(problem), lengths_(problem.atoms.size()) {
    for (std::size_t a = 0; a < lengths_.size(); ++a) lengths_[a] = 1.0 / root_of(problem.references[a]);
  }
  FoldoverFreeSolution<D> solve(std::vector<Place> start, const std::function<void(const FoldoverFreeIterate<D>&)>& on_step,
                                Progress& progress);

 private:
  /// What a set of displacements is worth, whatever epsilon is.
  struct Standing {
    std::size_t inverted = 0;
    double least = std::numeric_limits<double>::infinity();           // see FoldoverFreeIterate
    double least_jacobian = std::numeric_limits<double>::infinity();  // against the reference
  };

  static double root_of(double reference) {
    if constexpr (D == 2)
      return std::sqrt(reference);
    else
      return scalar::cube_root(reference);
  }
  /// In a unit in which its reference is 1.
  [[nodiscard]] MatrixAgainstIdeal<D> matrix(std::size_t atom, const std::vector<Place>& displacements) const {
    AtomEdges<D> edges = displaced_edges<D>(problem_, atom, displacements);
    for (auto& edge : edges)
      for (double& x : edge) x *= lengths_[atom];
    return {problem_.atoms[atom].shape, edges};
  }
  [[nodiscard]] Standing stand(const std::vector<Place>& displacements) const;
  [[nodiscard]] double energy(const std::vector<Place>& displacements) const;
  void assemble();
  /// Of an atom's energy by T.
  void derive(const MatrixAgainstIdeal<D>& t, typename AtomBlocks<D>::Gradient& g, typename AtomBlocks<D>::Hessian& h) const;
  [[nodiscard]] bool find_direction();
  [[nodiscard]] bool step();
  void lower_epsilon(double least_jacobian, double fall);

  const JointProblem<D>& problem_;
  const FoldoverFreeOptions& options_;
  AtomBlocks<D> system_;
  std::vector<double> lengths_;  // of each atom: its unit is the inverse
  std::vector<Place> at_, trial_;
  std::vector<double> gradient_, direction_;
  double epsilon_ = 1.0, energy_ = 0.0, fall_ = 0.0, damping_ = kFirstDamping, alpha_ = 1.0;
};

template <int D>
typename FoldoverFree<D>::Standing FoldoverFree<D>::stand(const std::vector<Place>& displacements) const {
  Standing result;
  for (std::size_t a = 0; a < problem_.atoms.size(); ++a) {
    const MatrixAgainstIdeal<D> t = matrix(a, displacements);
    result.inverted += t.determinant <= 0.0 ? 1 : 0;
    result.least_jacobian = std::min(result.least_jacobian, t.determinant);
    result.least = std::min(result.least, t.square > 0.0 ? inverse_norm_power<D>(t.square) * t.determinant : 0.0);
  }
  return result;
}

template <int D>
double FoldoverFree<D>::energy(const std::vector<Place>& displacements) const {
  double sum = 0.0;
  for (std::size_t a = 0; a < problem_.atoms.size(); ++a) {
    const MatrixAgainstIdeal<D> t = matrix(a, displacements);
    const double j = t.determinant, chi = Wall(j, epsilon_).value;
    sum += t.square / (D * power_of<D>(chi)) + options_.theta * (j * j + 1.0) / chi;
  }
  return sum;
}

/// The Hessian is that of the energy with J linear in the vertices and chi linear in J where shapes are concerned: positive semidefinite.
template <int D>
void FoldoverFree<D>::derive(const MatrixAgainstIdeal<D>& matrix, typename AtomBlocks<D>::Gradient& g,
                             typename AtomBlocks<D>::Hessian& h) const {
  const double j = matrix.determinant, p = 2.0 / D, theta = options_.theta;
  const Wall chi(j, epsilon_);
  const double s = 1.0 / power_of<D>(chi.value), shape = matrix.square / D * s, steep = chi.first / chi.value;
  const double size = (j * j + 1.0) / chi.value;
  const double by_j = -p * shape * steep + theta * (2.0 * j / chi.value - size * steep);
  const double bend = theta * (2.0 / chi.value - 4.0 * j / chi.value * steep + size * (2.0 * steep * steep - chi.second / chi.value));
  const double twice = p * (p + 1.0) * shape * steep * steep + std::max(0.0, bend), both = -p * (2.0 / D) * s * steep;
  const auto t = flat<D>(matrix.column, 1.0), c = flat<D>(matrix.cofactor, 1.0);
  for (std::size_t i = 0; i < kEdges; ++i) {
    g[i] = 2.0 / D * s * t[i] + by_j * c[i];
    for (std::size_t k = 0; k < kEdges; ++k) h[i * kEdges + k] = both * (t[i] * c[k] + c[i] * t[k]) + twice * (c[i] * c[k]);
    h[i * kEdges + i] += 2.0 / D * s;
  }
}

template <int D>
void FoldoverFree<D>::assemble() {
  system_.cholesky.clear();
  gradient_.assign(problem_.free_vertices * kD, 0.0);
  typename AtomBlocks<D>::Gradient g{};
  typename AtomBlocks<D>::Hessian h{};
  AtomDerivatives<D> derivatives;
  for (std::size_t a = 0; a < problem_.atoms.size(); ++a) {
    const MatrixAgainstIdeal<D> t = matrix(a, at_);
    derive(t, g, h);
    t.to_edges(g, h, derivatives);
    const double unit = lengths_[a];
    for (double& x : derivatives.gradient) x *= unit;
    for (double& x : derivatives.hessian) x *= unit * unit;
    typename AtomBlocks<D>::ByVertex none{};
    system_.add_hessian(a, derivatives.hessian, none);
    system_.add_gradient(a, 1.0, derivatives.gradient, gradient_);
  }
}

/// Newton's, with more and more of the diagonal on top where the matrix is singular.
template <int D>
bool FoldoverFree<D>::find_direction() {
  for (; damping_ <= kMostDamping; damping_ *= 10.0) {
    assemble();
    system_.scale_diagonal(1.0 + kOntoDiagonal + damping_);
    if (!system_.cholesky.factorise()) continue;
    direction_ = gradient_;
    for (double& x : direction_) x = -x;
    system_.cholesky.solve(direction_);
    return true;
  }
  return false;
}

template <int D>
bool FoldoverFree<D>::step() {
  if (!find_direction()) return false;
  double slope = 0.0;
  for (std::size_t i = 0; i < direction_.size(); ++i) slope += direction_[i] * gradient_[i];
  if (!(slope < 0.0)) return false;
  alpha_ = 1.0;
  for (int attempt = 0; attempt < 30; ++attempt, alpha_ *= 0.6) {
    for (std::size_t v = 0; v < at_.size(); ++v)
      for (std::size_t r = 0; r < kD; ++r) trial_[v][r] = at_[v][r] + alpha_ * direction_[v * kD + r];
    const double there = energy(trial_);
    if (!(there <= energy_ + 1e-4 * alpha_ * slope)) continue;
    fall_ = 1.0 - there / energy_;
    energy_ = there;
    at_.swap(trial_);
    return true;
  }
  return false;
}

/// As far as the energy's last fall allows that its next minimum is no higher: the paper's theorem 2.
template <int D>
void FoldoverFree<D>::lower_epsilon(double j, double fall) {
  const double mu = (1.0 - std::max(kLeastFall, fall)) * Wall(j, epsilon_).value;
  epsilon_ = j < mu ? std::min(epsilon_, 2.0 * std::sqrt(mu * (mu - j))) : kLeastEpsilon;
  epsilon_ = std::max(epsilon_, kLeastEpsilon);
}

template <int D>
FoldoverFreeSolution<D> FoldoverFree<D>::solve(std::vector<Place> start, const std::function<void(const FoldoverFreeIterate<D>&)>& on_step,
                                               Progress& progress) {
  FoldoverFreeSolution<D> solution;
  solution.best.assign(problem_.free_vertices, Place{});
  const Standing before = stand(solution.best);
  solution.start_inverted = solution.inverted = before.inverted;
  solution.start_least = solution.least = before.least;
  at_ = trial_ = std::move(start);
  Standing now = stand(at_);
  epsilon_ = now.least_jacobian > 0.0 ? 1e-3 : std::sqrt(1e-6 + 0.04 * now.least_jacobian * now.least_jacobian);
  energy_ = energy(at_);
  const auto keep = [&] {
    if (now.least < solution.start_least || now.inverted > solution.inverted) return;
    if (now.inverted == solution.inverted && now.least <= solution.least) return;
    solution.best = at_;
    solution.inverted = now.inverted;
    solution.least = now.least;
  };
  keep();
  for (int afterwards = 0; solution.steps < options_.max_steps && afterwards <= kAfterwards;) {
    progress.check();
    if (!step()) break;
    ++solution.steps;
    damping_ = alpha_ > 0.7 ? std::max(damping_ / 4.0, kLeastDamping) : alpha_ < 0.3 ? 4.0 * damping_ : damping_;
    now = stand(at_);
    keep();
    if (on_step) on_step({at_, solution.steps, now.inverted, now.least});
    if (now.inverted == 0) ++afterwards;
    if (epsilon_ < kHopeless * -now.least_jacobian) break;
    lower_epsilon(now.least_jacobian, fall_);
    energy_ = energy(at_);
    if (!std::isfinite(energy_)) break;
  }
  return solution;
}

}  // namespace

template <int D>
FoldoverFreeSolution<D> solve_foldover_free(const JointProblem<D>& problem, std::vector<std::array<double, D>> start,
                                            const FoldoverFreeOptions& options,
                                            const std::function<void(const FoldoverFreeIterate<D>&)>& on_step, Progress& progress) {
  return FoldoverFree<D>(problem, options).solve(std::move(start), on_step, progress);
}

template <int D>
std::vector<std::array<double, D>> sprung_displacements(const JointProblem<D>& problem) {
  constexpr std::size_t kD = D, kEdges = kD * kD;
  AtomBlocks<D> system(problem);
  std::vector<double> pull(problem.free_vertices * kD, 0.0);
  for (std::size_t a = 0; a < problem.atoms.size(); ++a) {
    const AtomShape shape = problem.atoms[a].shape;
    const bool simplex = shape == AtomShape::Triangle || shape == AtomShape::Tetrahedron;  // its other edges as well, e_i - e_j
    typename AtomBlocks<D>::Hessian h{};
    typename AtomBlocks<D>::Gradient g{};
    for (std::size_t i = 0; i < kEdges; ++i)
      for (std::size_t j = i % kD; j < kEdges; j += kD) {
        const double weight = i == j ? (simplex ? D : 1.0) : (simplex ? -1.0 : 0.0);
        h[i * kEdges + j] = weight;
        g[i] += weight * problem.edges[a][j / kD][j % kD];
      }
    system.add_hessian(a, h, {});
    system.add_gradient(a, -1.0, g, pull);
  }
  system.scale_diagonal(1.0 + kOntoDiagonal);
  std::vector<std::array<double, D>> result(problem.free_vertices);
  if (!system.cholesky.factorise()) return result;
  system.cholesky.solve(pull);
  for (std::size_t i = 0; i < pull.size(); ++i) result[i / kD][i % kD] = pull[i];
  return result;
}

template FoldoverFreeSolution<2> solve_foldover_free<2>(const JointProblem<2>&, std::vector<std::array<double, 2>>,
                                                        const FoldoverFreeOptions&,
                                                        const std::function<void(const FoldoverFreeIterate<2>&)>&, Progress&);
template FoldoverFreeSolution<3> solve_foldover_free<3>(const JointProblem<3>&, std::vector<std::array<double, 3>>,
                                                        const FoldoverFreeOptions&,
                                                        const std::function<void(const FoldoverFreeIterate<3>&)>&, Progress&);
template std::vector<std::array<double, 2>> sprung_displacements<2>(const JointProblem<2>&);
template std::vector<std::array<double, 3>> sprung_displacements<3>(const JointProblem<3>&);

}  // namespace dmoscope
