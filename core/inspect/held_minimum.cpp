#include "core/inspect/held_minimum.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/inspect/joint_hold.h"
#include "core/inspect/surface_trace.h"
#include "core/mesh/colouring.h"
#include "core/quality/quality.h"
#include "core/reference/hold.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

namespace {

constexpr int kRounds = 12;            // rounds of visits in a trial
constexpr double kAngleStep = 5.0;     // degrees; angles are proposed in multiples of it
constexpr double kMoreDeviation = 10;  // factor on the bound of deviation

bool is_possible(const SmoothingTask& task) {
  try {
    require_possible(task);
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

/// Conditions that decide what may move, which switches change.
struct Conditions {
  StandingRule rule;
  double max_deviation;
  std::vector<Index> by_hand;
  std::optional<CompositeTerms> combination;
};

/// Progress of the look, and whether it goes on.
struct Asking {
  Progress& progress;
  const std::function<bool()>& go_on;
  void check() const {
    progress.check();
    if (go_on && !go_on()) throw Cancelled();
  }
};

double angle_between(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)) / kDegree; }

/// The next greater angle that is proposed.
double angle_above(double angle) { return std::min(180.0, kAngleStep * (std::floor((angle + 0.5) / kAngleStep) + 1.0)); }

/// Examines one element.
class Look {
 public:
  Look(const HeldQuestion& question, Index element, std::span<const std::uint8_t> standing, ThreadPool* pool, const Asking& asking)
      : q_(question),
        input_(*question.task.input),
        mesh_(input_.mesh),
        element_(element),
        standing_(standing),
        pool_(pool),
        asking_(asking) {
    gather();
  }

  [[nodiscard]] HeldMinimum find() const {
    HeldMinimum found;
    found.element = element_;
    found.quality = found.unchanged = quality_of(q_.positions, element_);
    for (const Index v : std::set<Index>(corners().begin(), corners().end())) found.vertices.push_back({v, holding(v)});
    const std::vector<HoldSwitch> all = switches(found);
    // Runs a trial; once one was cut off, all later ones are.
    const auto attempt = [&](std::string_view what, double share, const auto& trial) {
      try {
        if (!found.untried.empty()) throw Cancelled();
        asking_.check();
        asking_.progress.set(share);
        trial();
      } catch (const Cancelled&) {
        found.untried.push_back(what);
      }
    };
    found.unchanged = found.quality;
    if (!q_.certified)
      attempt(kMoreIterations, 0.0, [&] { found.unchanged = std::max(found.quality, after(conditions(), q_.task.domain)); });
    double best = found.unchanged;
    if (!all.empty()) attempt("switches that could free it", 0.1, [&] { try_switches(found, all, best); });
    const bool stays = std::ranges::all_of(found.vertices, [](const HeldVertex& one) { return is_fixed(one.by); });
    const bool is_moot = stays || (found.rises() && !q_.joint_where_it_rises);
    // Tries a higher threshold, except below it: there the second aim does not count yet, and the threshold does not hold what rises.
    if (q_.task.combination && (!found.rises() || !(found.quality < q_.task.combination->threshold)))
      attempt("a higher threshold", 0.4, [&] { try_threshold(found, best); });
    if (q_.joint && (found.change || !is_moot)) attempt("joint moves", 0.5, [&] { try_joint(found, best); });
    if (!found.change && !found.rises() && !all.empty()) attempt("two switches together", 0.7, [&] { try_pairs(found, all); });
    if (found.change) std::erase_if(found.in_vain, [&](const HoldSwitch& one) { return one.frees == found.change->frees; });
    settle(found);
    return found;
  }

 private:
  [[nodiscard]] Conditions conditions() const {
    return {q_.rule, q_.max_deviation, {q_.by_hand.begin(), q_.by_hand.end()}, q_.task.combination};
  }
  static void take(HeldMinimum& found, const HoldSwitch& change, double there) {
    if (found.change) found.in_vain.push_back(*found.change);
    found.change = change;
    found.changed = there;
  }

  void try_switches(HeldMinimum& found, const std::vector<HoldSwitch>& all, double& best) const {
    for (const HoldSwitch& one : all) {
      asking_.check();
      const double there = after_switches({&one, 1});
      if (is_gain(best, there)) {
        take(found, one, best = there);
      } else if (!is_gain(found.unchanged, there)) {
        found.in_vain.push_back(one);
      }
    }
  }
  /// Tries two switches together, if none gains alone.
  void try_pairs(HeldMinimum& found, std::vector<HoldSwitch> all) const {
    const auto has = [&all](std::string_view name) { return std::ranges::find(all, name, &HoldSwitch::name) != all.end(); };
    // Adds a greater bound of deviation: a corner that becomes free to slide may need more room, and so may its neighbours before.
    if ((has("corner-angle") || has("feature-angle")) && !has("max-deviation") && q_.max_deviation < 1.0) {
      all.push_back(more_deviation());
      if (const double there = after_switches({&all.back(), 1}); is_gain(found.unchanged, there)) {
        found.change = all.back();
        found.changed = there;
        return;
      }
    }
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = i + 1; k < all.size(); ++k) {
        if (all[i].name == all[k].name) continue;
        asking_.check();
        const double there = after_switches({{all[i], all[k]}});
        if (!is_gain(found.change ? found.changed : found.unchanged, there)) continue;
        found.change = all[i], found.also = all[k];
        found.changed = there;
      }
  }
  /// Tries the first aim without the second: the threshold can be raised to what it reaches.
  void try_threshold(HeldMinimum& found, double& best) const {
    Conditions alone = conditions();
    alone.combination.reset();
    const CompositeTerms& now = *q_.task.combination;
    CompositeTerms raised = now;
    raised.threshold = std::min(0.99, std::floor(100.0 * after(alone, q_.task.domain)) / 100.0);
    if (!(raised.threshold > now.threshold)) return;
    const HoldSwitch change{"combine", to_text(q_.task.metric, raised), Holding::Threshold, raised.threshold, now.size_text()};
    if (const double there = after_switches({&change, 1}); is_gain(best, there)) take(found, change, best = there);
  }
  /// Tries joint moves of the vertices that may move.
  void try_joint(HeldMinimum& found, double& best) const {
    if (!(found.quality > 0.0)) return;
    auto cluster = joint_hold(input_, q_.positions, q_.fixed, {q_.task.domain, q_.task.max_deviation},
                              {q_.task.metric, q_.task.combination}, q_.joint_at_most, pool_, asking_.progress, asking_.go_on);
    if (!cluster) return;
    const bool same = !cluster->beyond && is_as_bad(quality_of(q_.positions, cluster->worst_element), found.quality);
    if (same && is_gain(best, cluster->after)) {
      if (!q_.joint_phase.empty())
        take(found, {"then", q_.joint_phase, Holding::Neighbours}, cluster->after);
      else if (!found.change && !q_.certified)
        found.unchanged = cluster->after;
      best = cluster->after;
    }
    found.joint = std::make_shared<const JointCluster>(std::move(*cluster));
  }
  [[nodiscard]] std::span<const Index> corners() const { return mesh_.elements.corners(element_); }
  [[nodiscard]] double quality_of(PositionView positions, Index e) const {
    return element_quality(input_.quality_context(), positions, q_.task.metric, e);
  }
  [[nodiscard]] bool on_boundary(Index v) const { return input_.topology.boundary()[v] != 0; }

  /// Gathers the elements that are judged, around the worst one, and the vertices that are visited, two rings of them.
  void gather() {
    std::set<Index> around(corners().begin(), corners().end()), elements;
    for (int ring = 0; ring < 2; ++ring) {
      std::set<Index> touched;
      for (const Index v : around)
        for (const Incidence& at : input_.topology.star(v)) touched.insert(at.element);
      if (ring == 0) judged_.assign(touched.begin(), touched.end());
      for (const Index e : touched) around.insert(mesh_.elements.corners(e).begin(), mesh_.elements.corners(e).end());
    }
    visited_.assign(around.begin(), around.end());
  }

  [[nodiscard]] bool between_materials(Index v) const {
    const auto star = input_.topology.star(v);
    return std::ranges::any_of(star, [&](const Incidence& at) { return input_.interfaces.between(star[0].element, at.element); });
  }

  [[nodiscard]] Holding holding(Index v) const {
    if (q_.fixed[v] == 0) return q_.task.domain && q_.task.domain->slides(v) ? Holding::Slides : Holding::Nothing;
    if (standing_[v] == 0) return Holding::Hand;
    if (q_.rule.layers == LayerRule::Keep && std::ranges::binary_search(input_.layers, v) && !on_boundary(v)) return Holding::Layer;
    switch (q_.task.domain ? q_.task.domain->held_on(v) : HeldOn::Nothing) {
      case HeldOn::Corner:
      case HeldOn::Hand:
        return Holding::Corner;
      case HeldOn::Junction:
      case HeldOn::End:
        return Holding::Feature;
      case HeldOn::Touching:
      case HeldOn::Unmatched:
        return Holding::Touching;
      case HeldOn::Tied:
        return Holding::Tied;
      case HeldOn::Named:
        return Holding::Named;
      case HeldOn::Nothing:
      case HeldOn::Rule:
        break;
    }
    if (on_boundary(v) && q_.rule.boundary == BoundaryRule::Fixed) return Holding::Boundary;
    if (input_.interfaces.meets_boundary_at(v) || between_materials(v)) return Holding::Interface;
    return on_boundary(v) ? Holding::Touching : Holding::Named;
  }

  /// Switches that concern the vertices of the element.
  [[nodiscard]] std::vector<HoldSwitch> switches(const HeldMinimum& found) const {
    std::vector<HoldSwitch> all;
    std::string by_hand;
    const auto any = [&](Holding by) { return std::ranges::find(found.vertices, by, &HeldVertex::by) != found.vertices.end(); };
    for (const HeldVertex& one : found.vertices)
      if (one.by == Holding::Hand) by_hand += fmt::format("{}{}", by_hand.empty() ? "" : " ", one.vertex);
    if (!by_hand.empty()) all.push_back({"unfix", by_hand, Holding::Hand});
    if (const std::string made = made_corners(found); !made.empty()) all.push_back({"auto-corner", made, Holding::Corner});
    if (any(Holding::Boundary)) all.push_back({"boundary", "slide", Holding::Boundary});
    if (any(Holding::Layer)) all.push_back({"layers", "free", Holding::Layer});
    if (any(Holding::Interface) && q_.rule.interfaces == InterfaceRule::Fixed) all.push_back({"interfaces", "slide", Holding::Interface});
    if (q_.task.domain) add_angles(found, all);
    if (any(Holding::Slides) && q_.max_deviation < 1.0) all.push_back(more_deviation());
    std::erase_if(all, [this](const HoldSwitch& one) {
      Conditions then = conditions();
      apply(one, then);
      return !is_possible(task_of(then, nullptr));
    });
    return all;
  }
  [[nodiscard]] HoldSwitch more_deviation() const {
    const double more = std::min(1.0, kMoreDeviation * q_.max_deviation);
    return {"max-deviation", fmt::format("{:.6g}", more), Holding::Deviation, more};
  }

  /// Numbers of the vertices that the user made corners: "4 7".
  [[nodiscard]] std::string made_corners(const HeldMinimum& found) const {
    std::string text;
    for (const HeldVertex& one : found.vertices)
      if (one.by == Holding::Corner && q_.rule.kinds.has_corner(one.vertex))
        text += fmt::format("{}{}", text.empty() ? "" : " ", one.vertex);
    return text;
  }

  /// Adds switches to the least angles that would change the kinds of the vertices, and to the greatest.
  void add_angles(const HeldMinimum& found, std::vector<HoldSwitch>& all) const {
    std::set<double> turns, folds;
    for (const HeldVertex& one : found.vertices) {
      const bool on_edge = one.by == Holding::Slides && q_.task.domain->on_curve(one.vertex);
      if (one.by != Holding::Corner && one.by != Holding::Feature && !on_edge) continue;
      const std::vector<Index> beside = along_curves(one.vertex);
      if (one.by == Holding::Corner && beside.size() == 2) turns.insert(angle_above(turn(beside[0], one.vertex, beside[1])));
      for (const Index other : beside)
        if (const auto angle = fold(one.vertex, other)) folds.insert(angle_above(*angle));
    }
    const auto add = [&all](const char* name, const std::set<double>& angles, double now, Holding frees) {
      std::set<double> ends;
      if (!angles.empty()) ends = {*angles.begin(), *angles.rbegin()};
      for (const double angle : ends)
        if (angle > now) all.push_back({name, fmt::format("{:g}", angle), frees, angle});
    };
    add("corner-angle", turns, q_.rule.corner_angle, Holding::Corner);
    add("feature-angle", folds, q_.rule.feature_angle, Holding::Feature);
  }
  /// Neighbours of a vertex along curves: edges of the boundary or an interface in a plane, else feature edges.
  [[nodiscard]] std::vector<Index> along_curves(Index v) const {
    const SlidingFaces& faces = q_.task.domain->faces();
    std::map<Index, std::vector<Index>> beside;  // by neighbour, the elements or faces at the edge
    const auto add = [&](std::span<const Index> c, Index of) {
      const auto i = static_cast<std::size_t>(std::ranges::find(c, v) - c.begin());
      for (const std::size_t other : {(i + 1) % c.size(), (i + c.size() - 1) % c.size()}) beside[c[other]].push_back(of);
    };
    if (faces.any())
      for (const Index f : faces.at(v)) add(faces.table().corners(f), f);
    else
      for (const Incidence& at : input_.topology.star(v)) add(mesh_.elements.corners(at.element), at.element);
    std::vector<Index> found;
    for (const auto& [other, at] : beside) {
      const bool along =
          faces.any() ? q_.task.domain->is_feature(v, other) : at.size() == 1 || input_.interfaces.between(at.front(), at.back());
      if (along) found.push_back(other);
    }
    return found;
  }
  /// Angle by which a curve of the input turns at a vertex, in degrees.
  [[nodiscard]] double turn(Index before, Index v, Index after) const {
    const Plane& plane = input_.geometry.plane;
    const auto& at = mesh_.positions;
    return angle_between(plane.difference(at[v], at[before]), plane.difference(at[after], at[v]));
  }
  /// Angle by which the surface of the input folds along an edge, in degrees; none unless exactly two facets meet there.
  [[nodiscard]] std::optional<double> fold(Index a, Index b) const {
    if (!q_.task.domain->faces().any() || !q_.task.domain->faces().are_own()) return std::nullopt;
    const Facets& facets = q_.task.domain->faces().facets();
    const auto sides = facets.sides_of(a, b);
    if (sides.size() != 2) return std::nullopt;
    const auto normal = [&](const FacetSide& side) {
      const auto& c = facets.facets()[side.facet].corners;
      return cross(facets.point(c[1]) - facets.point(c[0]), facets.point(c[2]) - facets.point(c[0]));
    };
    return angle_between(normal(sides[0]), normal(sides[1]));
  }

  void apply(const HoldSwitch& change, Conditions& then) const {
    const auto is_corner = [&](Index v) { return std::ranges::find(corners(), v) != corners().end(); };
    if (change.name == "boundary") then.rule.boundary = BoundaryRule::Slide;
    if (change.name == "layers") then.rule.layers = LayerRule::Free;
    if (change.name == "interfaces") then.rule.interfaces = InterfaceRule::Slide;
    if (change.name == "corner-angle") then.rule.corner_angle = change.number;
    if (change.name == "feature-angle") then.rule.feature_angle = change.number;
    if (change.name == "auto-corner") std::erase_if(then.rule.kinds.corners, is_corner);
    if (change.name == "max-deviation") then.max_deviation = change.number;
    if (change.name == "unfix") std::erase_if(then.by_hand, is_corner);
    if (change.name == "combine") then.combination->threshold = change.number;
  }
  /// The least quality of the judged elements after switches.
  [[nodiscard]] double after_switches(std::span<const HoldSwitch> changes) const {
    Conditions then = conditions();
    for (const HoldSwitch& change : changes) apply(change, then);
    if (then.rule == q_.rule) return after(then, q_.task.domain);
    if (!last_domain_ || last_domain_->first != then.rule)
      last_domain_.emplace(then.rule, q_.domains ? q_.domains(then.rule) : domain_for(input_, then.rule));
    return after(then, last_domain_->second);
  }
  [[nodiscard]] SmoothingTask task_of(const Conditions& then, std::shared_ptr<const Domain> domain) const {
    SmoothingTask task = q_.task;
    task.search.precision = Precision::Float;  // in double it finds only negligible gains more, at ten times the cost
    task.combination = then.combination;
    task.then_joint = task.then_mean = false;
    task.slides = lets_slide(input_, then.rule);
    task.domain = std::move(domain);
    task.max_deviation = then.max_deviation * input_.geometry.size;
    return task;
  }
  /// The least quality of the judged elements after some visits around the element.
  [[nodiscard]] double after(const Conditions& then, std::shared_ptr<const Domain> domain) const {
    std::vector<std::uint8_t> fixed = standing_vertices(input_, then.rule, domain.get());
    for (const Index v : then.by_hand) fixed[v] = 1;
    std::vector<Index> free = visited_;
    std::erase_if(free, [&](Index v) { return fixed[v] != 0 || (domain != nullptr && domain->leader(v) != kNoIndex); });
    SmoothingTask task = task_of(then, std::move(domain));
    task.colouring = std::make_shared<const Colouring>(colour_vertices(
        mesh_, input_.topology, free, nullptr, task.domain != nullptr ? task.domain->followers() : std::span<const Index>()));
    std::vector<Vec3> positions(q_.positions.begin(), q_.positions.end());
    const auto smoother = make_smoother(task);
    smoother->positions_replaced();
    visit(*smoother, task.colouring->order.size(), positions);
    smoother->store(positions, nullptr);
    double worst = std::numeric_limits<double>::infinity();
    for (const Index e : judged_)
      if (const double quality = quality_of(positions, e); !std::isnan(quality)) worst = std::min(worst, quality);
    return worst;
  }
  void visit(Smoother& smoother, std::uint64_t count, std::span<Vec3> positions) const {
    for (int round = 0; round < kRounds; ++round) {
      smoother.begin({.iteration = static_cast<std::uint64_t>(round), .untangling = q_.untangling});
      asking_.check();
      if (smoother.visit(0, count, positions, nullptr) == 0) return;
    }
  }

  /// Sets the one word for what holds the minimum.
  void settle(HeldMinimum& found) const {
    if (found.change) {
      found.by = found.change->frees;
      for (HeldVertex& one : found.vertices)
        if (one.by == Holding::Slides &&
            (found.by == Holding::Deviation || (found.by == Holding::Feature && q_.task.domain->on_curve(one.vertex))))
          one.by = found.by;
      return;
    }
    std::ptrdiff_t most = 0;
    for (const HeldVertex& one : found.vertices) {
      if (!is_fixed(one.by)) continue;
      const auto count = std::ranges::count(found.vertices, one.by, &HeldVertex::by);
      if (count > most) most = count, found.by = one.by;
    }
    const bool slides = std::ranges::find(found.vertices, Holding::Slides, &HeldVertex::by) != found.vertices.end();
    if (most > 0 || !slides) return;
    found.by = Holding::Slides;
    if (!found.rises() && found.untried.empty()) look_into_visits(found);
  }

  /// Finds out whether vertices on a surface are refused a gain because faces would deviate or lean too much.
  void look_into_visits(HeldMinimum& found) const {
    const SmoothingTask task = task_of(conditions(), q_.task.domain);
    for (HeldVertex& one : found.vertices) {
      if (one.by != Holding::Slides || !q_.task.domain->on_surface(one.vertex) || q_.task.method != "dmo") continue;
      const VisitEnd end = trace_surface_visit(task, q_.positions, one.vertex, {}).trace.end;
      if (end == VisitEnd::Leans) one.by = Holding::Tilt;
      if (end == VisitEnd::Deviates) one.by = Holding::Deviation;
      if (one.by != Holding::Slides) found.by = one.by;
    }
  }

  const HeldQuestion& q_;
  const InputMesh& input_;
  const Mesh& mesh_;
  Index element_;
  std::span<const std::uint8_t> standing_;
  ThreadPool* pool_;
  const Asking& asking_;
  std::vector<Index> judged_, visited_;
  mutable std::optional<std::pair<StandingRule, std::shared_ptr<const Domain>>> last_domain_{};  // kept: costs more than a trial
};

/// The worst element of all, and the worst with a corner that is not fixed; kNoIndex: there is none.
std::pair<Index, Index> worst_elements(const HeldQuestion& question, ThreadPool* pool) {
  const Mesh& mesh = question.task.input->mesh;
  std::vector<double> qualities(mesh.elements.size());
  element_qualities(question.task.input->quality_context(), question.positions, question.task.metric, pool, qualities);
  Index worst = kNoIndex, movable = kNoIndex;
  for (Index e = 0; e < qualities.size(); ++e) {
    if (std::isnan(qualities[e])) continue;
    if (worst == kNoIndex || qualities[e] < qualities[worst]) worst = e;
    if (movable != kNoIndex && !(qualities[e] < qualities[movable])) continue;
    const auto corners = mesh.elements.corners(e);
    if (std::ranges::any_of(corners, [&](Index v) { return question.fixed[v] == 0; })) movable = e;
  }
  return {worst, movable};
}

}  // namespace

std::optional<HeldMinimum> held_minimum(const HeldQuestion& question, ThreadPool* pool, Progress& progress,
                                        const std::function<bool()>& go_on) {
  const auto [worst, movable] = worst_elements(question, pool);
  if (worst == kNoIndex) return std::nullopt;
  const std::vector<std::uint8_t> standing = standing_vertices(*question.task.input, question.rule, question.task.domain.get());
  const Asking asking{progress, go_on};
  HeldMinimum found = Look(question, worst, standing, pool, asking).find();
  if (found.change || movable == kNoIndex || movable == worst || found.rises() || !found.untried.empty()) return found;
  const bool stays = std::ranges::all_of(found.vertices, [](const HeldVertex& one) { return is_fixed(one.by); });
  if (!stays) return found;
  HeldMinimum next = Look(question, movable, standing, pool, asking).find();
  next.ceiling = {found.element, found.quality};
  return next;
}

}  // namespace dmoscope
