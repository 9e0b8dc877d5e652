#include "core/joint/interior_point.h"

#include <algorithm>
#include <cmath>

#include "core/joint/atom_blocks.h"
#include "core/joint/defined_atoms.h"
#include "core/numeric/product_log.h"

namespace dmoscope {

namespace {

constexpr double kFirstMargin = 0.05;  // tau begins this far above the greatest f
constexpr double kLeastSlack = 0.005;  // share of its slack that an atom keeps in one step
constexpr double kCentred = 10.0;      // Newton's decrement below which a full step suffices before mu falls
constexpr int kEnoughFullSteps = 4;    // number in a row after which mu falls even if none centres, as where sizes differ
constexpr double kFall = 0.3;          // factor by which mu falls
constexpr double kFirstDamping = 0.1, kLeastDamping = 1e-4, kMostDamping = 1e4;
constexpr double kOntoDiagonal = 1e-9;                     // share of the diagonal that is added against rounding
constexpr std::size_t kGrain = 128;                        // atoms that a thread takes at once
constexpr std::size_t kAloneAtOnce = 256, kAtOnce = 2048;  // atoms that one thread, or all, take before the ordered sums

template <int D>
class InteriorPoint {
 public:
  InteriorPoint(const JointProblem<D>& problem, const AtomFunction<D>& function, ThreadPool* pool);
  JointSolution<D> solve(const InteriorPointOptions& options, const JointCallbacks<D>& callbacks, Progress& progress);

 private:
  static constexpr std::size_t kD = D, kVertices = kD + 1, kEdges = kD * kD;
  using Place = std::array<double, kD>;

  [[nodiscard]] double value(std::size_t atom, const std::vector<Place>& displacements) const;
  void evaluate(std::size_t first, std::size_t end, const std::vector<Place>& displacements, std::vector<double>& values) const;
  [[nodiscard]] std::size_t at_once() const { return pool_ != nullptr ? kAtOnce : kAloneAtOnce; }
  [[nodiscard]] double slack(std::size_t atom) const { return problem_.bound(atom, at_.tau) - at_.values[atom]; }
  [[nodiscard]] const AtomFunction<D>& function(std::size_t atom) const { return atom < own_ ? function_ : *problem_.limited; }
  /// Weight of an atom in the sum, where that falls; else 0.
  [[nodiscard]] double weight(std::size_t atom) const { return atom < own_ && problem_.atoms[atom].piece != kGuardPiece ? weight_ : 0.0; }
  [[nodiscard]] double sum() const {
    double sum = 0.0;
    for (std::size_t a = 0; a < own_; ++a) sum += weight(a) * at_.values[a];
    return sum;
  }
  /// The objective: the greatest f of the raised atoms, or the sum over that at the start.
  [[nodiscard]] double worst() const {
    if (raised_ == 0) return sum();
    return *std::max_element(at_.values.begin(), at_.values.begin() + static_cast<std::ptrdiff_t>(raised_));
  }
  /// Share of an atom in the Lagrangian.
  [[nodiscard]] double share(std::size_t atom) const { return at_.multipliers[atom] + weight(atom); }
  bool start();
  void choose_ways();
  void assemble(Curvature curvature);
  void add_atom(std::size_t atom, const AtomDerivatives<D>& derivatives);
  using Damping = std::array<double, kVertices>;
  [[nodiscard]] Damping damping(std::size_t atom, const AtomDerivatives<D>& derivatives) const;
  [[nodiscard]] bool factorise();
  void find_direction();
  [[nodiscard]] bool search_line();
  void step_multipliers();
  [[nodiscard]] bool is_centred() const { return (alpha_ > 0.9 && -slope_ < kCentred) || -slope_ < 1e-3; }

  const JointProblem<D>& problem_;
  const AtomFunction<D>& function_;
  std::size_t raised_;   // number of raised atoms, the first ones
  std::size_t own_;      // number of atoms raised or in the sum: those whose f is `function_`
  double weight_ = 0.0;  // weight of each f in the sum, where that falls
  ThreadPool* pool_;
  AtomBlocks<D> system_;
  JointIterate<D> at_;
  // Quantities of the step under way.
  std::vector<AtomDerivatives<D>> derivatives_;        // derivatives of a batch of atoms
  std::vector<std::array<double, kEdges>> gradients_;  // gradients by edges
  std::vector<double> ratios_, changes_, new_values_;  // multiplier / slack, multipliers' steps
  std::vector<double> direction_, tau_direction_;      // dx, and its part that goes with dtau
  std::vector<double> force_;                          // sum of mu / slack * gradient
  std::vector<Place> trial_;
  double ratio_sum_ = 0.0, barrier_sum_ = 0.0;  // sums of multiplier / slack, and of mu / slack
  double dtau_ = 0.0, slope_ = 0.0, alpha_ = 0.0;
  std::vector<std::size_t> bound_atoms_;  // atoms with a sliding vertex
  double sigma_ = kFirstDamping;
  bool exact_ = true;
};

template <int D>
InteriorPoint<D>::InteriorPoint(const JointProblem<D>& problem, const AtomFunction<D>& function, ThreadPool* pool)
    : problem_(problem),
      function_(function),
      raised_(problem.raised()),
      own_(raised_ > 0 ? raised_ : problem.atoms.size() - problem.beside),
      pool_(pool),
      system_(problem, pool) {
  if (problem.path == nullptr) return;
  const auto bound = problem.path->bound();
  for (std::size_t a = 0; a < problem.atoms.size(); ++a)
    if (std::ranges::any_of(problem.atoms[a].vertices, [&](Index v) { return v < problem.free_vertices && bound[v] != 0; }))
      bound_atoms_.push_back(a);
}

template <int D>
double InteriorPoint<D>::value(std::size_t atom, const std::vector<Place>& displacements) const {
  return function(atom).value(problem_.atoms[atom], displaced_edges<D>(problem_, atom, displacements), problem_.reference(atom));
}

/// Evaluates f of some atoms.
template <int D>
void InteriorPoint<D>::evaluate(std::size_t first, std::size_t end, const std::vector<Place>& displacements,
                                std::vector<double>& values) const {
  for_chunks(end - first > kGrain ? pool_ : nullptr, end - first, kGrain, [&](std::size_t from, std::size_t to) {
    for (std::size_t a = first + from; a < first + to; ++a) values[a] = value(a, displacements);
  });
}

/// Begins at the undisplaced vertices. False where an f is infinite, or not below its limit.
template <int D>
bool InteriorPoint<D>::start() {
  const std::size_t count = problem_.atoms.size();
  at_.displacements.assign(problem_.free_vertices, Place{});
  at_.values.resize(count);
  at_.multipliers.resize(count);
  evaluate(0, count, at_.displacements, at_.values);
  if (raised_ == 0) {
    weight_ = 1.0;
    weight_ = 1.0 / sum();
  }
  at_.worst = worst();
  if (!std::isfinite(at_.worst)) return false;
  for (std::size_t a = raised_; a < count; ++a)
    if (!(slack(a) > 0.0)) return false;
  at_.tau = raised_ == 0 ? 1.0 : at_.worst + kFirstMargin * std::fabs(at_.worst);
  double sum = 0.0;
  for (std::size_t a = 0; a < raised_; ++a) sum += 1.0 / slack(a);
  at_.mu = 1.0 / sum;
  if (raised_ == 0) {
    for (std::size_t a = 0; a < count; ++a) sum += slack(a);
    at_.mu = weight_ * sum / static_cast<double>(count);
  }
  for (std::size_t a = 0; a < count; ++a) at_.multipliers[a] = at_.mu / slack(a);
  gradients_.resize(count);
  ratios_.resize(count);
  changes_.resize(count);
  new_values_.resize(count);
  trial_ = at_.displacements;
  return true;
}

/// Chooses the directions of sliding vertices by the forces that draw them: at a corner of a curve one of its two sides counts.
template <int D>
void InteriorPoint<D>::choose_ways() {
  if (problem_.path == nullptr) return;
  std::vector<double> forces(problem_.free_vertices * kD, 0.0);
  AtomDerivatives<D> derivatives;
  for (const std::size_t a : bound_atoms_) {
    function(a).derive(problem_.atoms[a], displaced_edges<D>(problem_, a, at_.displacements), problem_.reference(a), Curvature::Exact,
                       derivatives);
    system_.add_gradient(a, -at_.mu / slack(a) - weight(a), derivatives.gradient, forces);
  }
  problem_.path->choose(forces);
}

/// Assembles K, the Hessian of the Lagrangian and the barrier, and the sums that go with it, with damping.
template <int D>
void InteriorPoint<D>::assemble(Curvature curvature) {
  system_.cholesky.clear();
  force_.assign(problem_.free_vertices * kD, 0.0);
  tau_direction_.assign(problem_.free_vertices * kD, 0.0);
  ratio_sum_ = barrier_sum_ = 0.0;
  // Lets one thread add up some atoms while the others derive the next.
  const std::size_t count = problem_.atoms.size(), size = at_once();
  derivatives_.resize(2 * std::min(count, size));
  const auto derive = [&](std::size_t from, std::size_t to) {
    for (std::size_t a = from; a < to; ++a)
      function(a).derive(problem_.atoms[a], displaced_edges<D>(problem_, a, at_.displacements), problem_.reference(a), curvature,
                         derivatives_[a % (2 * size)]);
  };
  derive(0, std::min(count, size));
  for (std::size_t first = 0; first < count; first += size) {
    const std::size_t next = std::min(first + size, count), end = std::min(next + size, count), parts = (end - next + kGrain - 1) / kGrain;
    const auto work = [&](std::size_t from, std::size_t to) {
      for (std::size_t part = from; part < to; ++part) {
        if (part > 0) {
          derive(next + (part - 1) * kGrain, std::min(next + part * kGrain, end));
          continue;
        }
        for (std::size_t a = first; a < next; ++a) add_atom(a, derivatives_[a % (2 * size)]);
      }
    };
    for_chunks(parts > 1 ? pool_ : nullptr, 1 + parts, 1, work);
  }
  system_.project(force_);
  system_.project(tau_direction_);
  system_.hold();
  system_.scale_diagonal(1.0 + kOntoDiagonal);
}

/// Stiffness of an atom's vertices, times its multiplier: the mean of its Hessian's diagonal there, or where that may vanish the gradient
/// over the edges' length.
template <int D>
typename InteriorPoint<D>::Damping InteriorPoint<D>::damping(std::size_t atom, const AtomDerivatives<D>& derivatives) const {
  Damping result{};
  const double multiplier = share(atom);
  if (function(atom).convex_by_vertex()) {
    for (std::size_t r = 0; r < kD; ++r) {
      double of_first = 0.0;
      for (std::size_t i = 0; i < kD; ++i) {
        for (std::size_t j = 0; j < kD; ++j) of_first += derivatives.hessian[(i * kD + r) * kEdges + j * kD + r];
        result[i + 1] += std::fabs(derivatives.hessian[(i * kD + r) * kEdges + i * kD + r]);
      }
      result[0] += std::fabs(of_first);
    }
    for (double& x : result) x *= multiplier / D;
    return result;
  }
  double slope = 0.0, length = 0.0;
  for (const double g : derivatives.gradient) slope += g * g;
  for (const Place& edge : displaced_edges<D>(problem_, atom, at_.displacements))
    for (const double x : edge) length += x * x;
  const double stiff = length > 0.0 ? multiplier * std::sqrt(slope / length) : 0.0;
  result.fill(stiff);
  result[0] = D * stiff;  // the first vertex is in every edge
  return result;
}

template <int D>
void InteriorPoint<D>::add_atom(std::size_t atom, const AtomDerivatives<D>& derivatives) {
  const double multiplier = share(atom), s = slack(atom), ratio = at_.multipliers[atom] / s, barrier = at_.mu / s + weight(atom);
  const auto& g = gradients_[atom] = derivatives.gradient;
  Damping damped = damping(atom, derivatives);
  for (double& x : damped) x *= sigma_;
  std::array<double, kEdges * kEdges> h;
  for (std::size_t i = 0; i < kEdges; ++i)
    for (std::size_t j = 0; j < kEdges; ++j) h[i * kEdges + j] = multiplier * derivatives.hessian[i * kEdges + j] + ratio * g[i] * g[j];
  system_.add_hessian(atom, h, damped);
  system_.add_gradient(atom, barrier, g, force_);
  ratios_[atom] = ratio;
  if (atom >= raised_) return;
  system_.add_gradient(atom, ratio, g, tau_direction_);
  ratio_sum_ += ratio;
  barrier_sum_ += barrier;
}

/// Assembles and factorises: with the exact Hessian, then with the convex one, then with more and more damping.
template <int D>
bool InteriorPoint<D>::factorise() {
  assemble(exact_ ? Curvature::Exact : Curvature::Convex);
  for (int attempt = 0; attempt < 12; ++attempt) {
    if (system_.cholesky.factorise()) {
      if (attempt == 0) exact_ = true;  // the exact Hessian may have become definite again
      return true;
    }
    if (exact_)
      exact_ = false;
    else
      sigma_ = std::max(10.0 * sigma_, 1e-3);
    assemble(Curvature::Convex);
  }
  return false;
}

/// Newton's step in displacements and tau. Eliminating the multipliers leaves K dx = b dtau - r, and b . dx - sum(ratio) dtau =
/// 1 - sum(mu / slack).
template <int D>
void InteriorPoint<D>::find_direction() {
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  };
  const std::vector<double> b = tau_direction_;
  direction_ = force_;
  for (double& x : direction_) x = -x;
  system_.cholesky.solve(direction_, tau_direction_);
  if (raised_ == 0) {
    dtau_ = 0.0;
    slope_ = dot(force_, direction_) / at_.mu;
    return;
  }
  dtau_ = (1.0 - barrier_sum_ - dot(b, direction_)) / (dot(b, tau_direction_) - ratio_sum_);
  for (std::size_t i = 0; i < direction_.size(); ++i) direction_[i] += dtau_ * tau_direction_[i];
  slope_ = (dtau_ * (1.0 - barrier_sum_) + dot(force_, direction_)) / at_.mu;
}

/// Shortens the step until every atom keeps some slack and tau / mu - sum of log(slack) falls. Then takes it.
template <int D>
bool InteriorPoint<D>::search_line() {
  alpha_ = 1.0;
  for (int attempt = 0; attempt < 30; ++attempt, alpha_ *= 0.6) {
    const double tau = at_.tau + alpha_ * dtau_;
    for (std::size_t v = 0; v < trial_.size(); ++v)
      for (std::size_t r = 0; r < kD; ++r) trial_[v][r] = at_.displacements[v][r] + alpha_ * direction_[v * kD + r];
    if (problem_.path != nullptr && !problem_.path->put_back(at_.displacements, trial_)) continue;
    ProductLog slacks;  // product of the new slacks over the old ones
    double rise = 0.0;  // rise of the sum
    bool inside = true;
    for (std::size_t a = 0; a < new_values_.size() && inside; ++a) {
      if (a % at_once() == 0) evaluate(a, std::min(a + at_once(), new_values_.size()), trial_, new_values_);
      const double left = (problem_.bound(a, tau) - new_values_[a]) / slack(a);
      inside = left > kLeastSlack && std::isfinite(left);
      if (inside) slacks.multiply(left);
      rise += weight(a) * (new_values_[a] - at_.values[a]);
    }
    if (!inside) continue;
    const double change = (alpha_ * dtau_ + rise) / at_.mu - slacks.value();
    if (!(change <= 1e-4 * alpha_ * slope_ + 1e-12 * (1.0 + std::fabs(at_.tau / at_.mu)))) continue;
    step_multipliers();
    if (problem_.path != nullptr) problem_.path->take();
    at_.tau = tau;
    at_.displacements.swap(trial_);
    at_.values.swap(new_values_);
    at_.worst = worst();
    return true;
  }
  return false;
}

/// Changes of the multipliers that go with the full step; slacks are still the old ones.
template <int D>
void InteriorPoint<D>::step_multipliers() {
  double longest = 1.0;
  for (std::size_t a = 0; a < changes_.size(); ++a) {
    const auto& vertices = problem_.atoms[a].vertices;
    double rise = 0.0;  // rise of f, to first order
    for (std::size_t j = 0; j < kD; ++j)
      for (std::size_t r = 0; r < kD; ++r) {
        const double other = system_.is_free(a, j + 1) ? direction_[vertices[j + 1] * kD + r] : 0.0;
        const double first = system_.is_free(a, 0) ? direction_[vertices[0] * kD + r] : 0.0;
        rise += gradients_[a][j * kD + r] * (other - first);
      }
    changes_[a] = at_.mu / slack(a) - at_.multipliers[a] - ratios_[a] * ((a < raised_ ? dtau_ : 0.0) - rise);
    if (changes_[a] < 0.0) longest = std::min(longest, -0.995 * at_.multipliers[a] / changes_[a]);
  }
  for (std::size_t a = 0; a < changes_.size(); ++a) at_.multipliers[a] += longest * changes_[a];
}

template <int D>
JointSolution<D> InteriorPoint<D>::solve(const InteriorPointOptions& options, const JointCallbacks<D>& callbacks, Progress& progress) {
  JointSolution<D> solution;
  const bool sound = start();
  solution.best = at_.displacements;
  solution.best_worst = solution.start_worst = at_.worst;
  if (!sound) {
    solution.last = std::move(at_);
    return solution;
  }
  solution.end = InteriorPointEnd::Steps;
  const auto within = [&](double gap) { return at_.gap() < gap * std::fabs(at_.tau); };
  bool asked = options.early_gap <= 0.0 || !callbacks.leave_early;
  int full_steps = 0;
  for (int attempt = 0; attempt < options.max_steps; ++attempt) {
    progress.check();
    choose_ways();
    if (!factorise()) {
      solution.end = InteriorPointEnd::Stuck;
      break;
    }
    find_direction();
    if (!search_line()) {
      if (!within(options.gap) && sigma_ < kMostDamping) {
        sigma_ = std::min(std::max(sigma_, 1e-3) * 16.0, kMostDamping);
        continue;
      }
      solution.end = within(options.gap) ? InteriorPointEnd::Gap : InteriorPointEnd::Stuck;
      break;
    }
    ++at_.steps;
    if (alpha_ < 0.3)
      sigma_ = std::min(4.0 * sigma_, kMostDamping);
    else if (alpha_ > 0.7)
      sigma_ = std::max(sigma_ / 4.0, kLeastDamping);
    for (std::size_t a = 0; a < at_.values.size(); ++a) {
      const double plain = at_.mu / slack(a);
      at_.multipliers[a] = std::clamp(at_.multipliers[a], 1e-3 * plain, 1e3 * plain);
    }
    if (at_.worst < solution.best_worst) {
      solution.best_worst = at_.worst;
      solution.best = at_.displacements;
      if (problem_.path != nullptr) problem_.path->keep_best();
    }
    if (callbacks.step) callbacks.step(at_);
    if (solution.best_worst <= options.enough) {
      solution.end = InteriorPointEnd::Enough;
      break;
    }
    full_steps = alpha_ > 0.9 ? full_steps + 1 : 0;
    if (!is_centred() && full_steps < kEnoughFullSteps) continue;
    full_steps = 0;
    if (within(options.gap)) {
      solution.end = InteriorPointEnd::Gap;
      break;
    }
    if (!asked && within(options.early_gap)) {
      asked = true;
      if (callbacks.leave_early(at_)) {
        solution.end = InteriorPointEnd::LeftEarly;
        break;
      }
    }
    at_.mu *= kFall;
  }
  choose_ways();  // sets the ways that hold them at the end
  solution.last = std::move(at_);
  return solution;
}

}  // namespace

template <int D>
JointSolution<D> solve_joint(const JointProblem<D>& problem, const AtomFunction<D>& function, const InteriorPointOptions& options,
                             const JointCallbacks<D>& callbacks, Progress& progress) {
  return InteriorPoint<D>(problem, function, options.pool).solve(options, callbacks, progress);
}
template JointSolution<2> solve_joint<2>(const JointProblem<2>&, const AtomFunction<2>&, const InteriorPointOptions&,
                                         const JointCallbacks<2>&, Progress&);
template JointSolution<3> solve_joint<3>(const JointProblem<3>&, const AtomFunction<3>&, const InteriorPointOptions&,
                                         const JointCallbacks<3>&, Progress&);

}  // namespace dmoscope
