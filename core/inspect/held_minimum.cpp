#include "core/inspect/held_minimum.h"

#include <algorithm>
#include <cmath>
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

constexpr int kRounds = 12;            // of visits in a trial
constexpr double kAngleStep = 5.0;     // degrees: angles are proposed in multiples of it
constexpr double kMoreDeviation = 10;  // times the bound

/// A few words changed about what may move.
struct Conditions {
  StandingRule rule;
  double max_deviation;
  std::vector<Index> by_hand;
};

double angle_between(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)) / kDegree; }

/// The next proposed angle that is greater.
double angle_above(double angle) { return std::min(180.0, kAngleStep * (std::floor((angle + 0.5) / kAngleStep) + 1.0)); }

/// What is asked about one element.
class Look {
 public:
  Look(const HeldQuestion& question, Index element, std::span<const std::uint8_t> standing, ThreadPool* pool)
      : q_(question), mesh_(question.input->mesh), element_(element), standing_(standing), pool_(pool) {
    gather();
  }

  [[nodiscard]] HeldMinimum find(Progress& progress, const std::function<bool()>& go_on) const {
    HeldMinimum found;
    found.element = element_;
    found.quality = quality_of(q_.positions, element_);
    for (const Index v : std::set<Index>(corners().begin(), corners().end())) found.vertices.push_back({v, holding(v)});
    const std::vector<HoldSwitch> all = switches(found);
    const auto check = [&](std::size_t done) {
      progress.check();
      if (go_on && !go_on()) throw Cancelled();
      progress.set(static_cast<double>(done) / static_cast<double>(all.size() + 1));
    };
    check(0);
    found.unchanged = std::max(found.quality, after({q_.rule, q_.max_deviation, {q_.by_hand.begin(), q_.by_hand.end()}}, q_.domain));
    double best = found.unchanged;
    for (std::size_t i = 0; i < all.size(); ++i) {
      check(i + 1);
      const double there = after_switches({&all[i], 1});
      if (is_gain(best, there)) {
        if (found.change) found.in_vain.push_back(*found.change);
        best = found.changed = there;
        found.change = all[i];
      } else if (!is_gain(found.unchanged, there)) {
        found.in_vain.push_back(all[i]);
      }
    }
    const bool stays = std::ranges::all_of(found.vertices, [](const HeldVertex& one) { return is_fixed(one.by); });
    const bool is_moot = stays || (found.rises() && !q_.joint_where_it_rises);
    if (found.change || !is_moot) try_joint(found, best, progress, go_on);
    if (!found.change && !found.rises()) try_pairs(found, all, check);
    if (found.change) std::erase_if(found.in_vain, [&](const HoldSwitch& one) { return one.frees == found.change->frees; });
    settle(found);
    return found;
  }

 private:
  /// Two switches together, where none gains alone.
  template <class Check>
  void try_pairs(HeldMinimum& found, std::vector<HoldSwitch> all, const Check& check) const {
    const auto has = [&all](std::string_view name) { return std::ranges::find(all, name, &HoldSwitch::name) != all.end(); };
    // What does not slide as long as it is a corner may need more room afterwards; so may its neighbours, before.
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
        check(all.size());
        const double there = after_switches({{all[i], all[k]}});
        if (!is_gain(found.change ? found.changed : found.unchanged, there)) continue;
        found.change = all[i], found.also = all[k];
        found.changed = there;
      }
  }
  /// Joint moves, where a vertex may move: of sliding ones they hold the place.
  void try_joint(HeldMinimum& found, double& best, Progress& progress, const std::function<bool()>& go_on) const {
    std::vector<std::uint8_t> fixed(q_.fixed.begin(), q_.fixed.end());
    if (q_.domain != nullptr)
      for (Index v = 0; v < fixed.size(); ++v)
        if (q_.domain->slides(v)) fixed[v] = 1;
    auto cluster = joint_hold(*q_.input, q_.positions, fixed, q_.metric, element_, q_.joint_at_most, pool_, progress, go_on);
    if (!cluster) return;
    const bool same = is_as_bad(quality_of(q_.positions, cluster->worst_element), found.quality);
    if (same && is_gain(best, cluster->after)) {
      if (!q_.joint_phase.empty()) {
        if (found.change) found.in_vain.push_back(*found.change);
        found.change = HoldSwitch{"then", q_.joint_phase, Holding::Neighbours};
        found.changed = cluster->after;
      } else if (!found.change) {
        found.unchanged = cluster->after;
      }
      best = cluster->after;
    }
    found.joint = std::make_shared<const JointCluster>(std::move(*cluster));
  }
  [[nodiscard]] std::span<const Index> corners() const { return mesh_.elements.corners(element_); }
  [[nodiscard]] double quality_of(PositionView positions, Index e) const {
    return element_quality(q_.input->quality_context(), positions, q_.metric, e);
  }
  [[nodiscard]] bool on_boundary(Index v) const { return q_.input->topology.boundary()[v] != 0; }

  /// The elements that are judged, around the worst one, and the vertices that are visited, two rings of them.
  void gather() {
    std::set<Index> around(corners().begin(), corners().end()), elements;
    for (int ring = 0; ring < 2; ++ring) {
      std::set<Index> touched;
      for (const Index v : around)
        for (const Incidence& at : q_.input->topology.star(v)) touched.insert(at.element);
      if (ring == 0) judged_.assign(touched.begin(), touched.end());
      for (const Index e : touched) around.insert(mesh_.elements.corners(e).begin(), mesh_.elements.corners(e).end());
    }
    visited_.assign(around.begin(), around.end());
  }

  [[nodiscard]] bool between_materials(Index v) const {
    const auto star = q_.input->topology.star(v);
    return std::ranges::any_of(star, [&](const Incidence& at) { return q_.input->interfaces.between(star[0].element, at.element); });
  }

  [[nodiscard]] Holding holding(Index v) const {
    if (q_.fixed[v] == 0) return q_.domain != nullptr && q_.domain->slides(v) ? Holding::Slides : Holding::Nothing;
    if (standing_[v] == 0) return Holding::Hand;
    switch (q_.domain != nullptr ? q_.domain->held_on(v) : HeldOn::Nothing) {
      case HeldOn::Corner:
      case HeldOn::Hand:
        return Holding::Corner;
      case HeldOn::Junction:
      case HeldOn::End:
        return Holding::Feature;
      case HeldOn::Touching:
      case HeldOn::Unmatched:
        return Holding::Touching;
      case HeldOn::Named:
        return Holding::Named;
      case HeldOn::Nothing:
      case HeldOn::Rule:
        break;
    }
    if (on_boundary(v) && q_.rule.boundary == BoundaryRule::Fixed) return Holding::Boundary;
    if (q_.input->interfaces.meets_boundary_at(v) || between_materials(v)) return Holding::Interface;
    return on_boundary(v) ? Holding::Touching : Holding::Named;
  }

  /// What concerns the vertices of the element.
  [[nodiscard]] std::vector<HoldSwitch> switches(const HeldMinimum& found) const {
    std::vector<HoldSwitch> all;
    std::string by_hand;
    const auto any = [&](Holding by) { return std::ranges::find(found.vertices, by, &HeldVertex::by) != found.vertices.end(); };
    const bool slides = method_info(q_.method).slides && !(q_.input->geometry.plane.period > 0.0);
    for (const HeldVertex& one : found.vertices)
      if (one.by == Holding::Hand) by_hand += fmt::format("{}{}", by_hand.empty() ? "" : " ", one.vertex);
    if (!by_hand.empty()) all.push_back({"unfix", by_hand, Holding::Hand});
    if (!slides) return all;
    if (const std::string made = made_corners(found); !made.empty()) all.push_back({"auto-corner", made, Holding::Corner});
    if (any(Holding::Boundary)) all.push_back({"boundary", "slide", Holding::Boundary});
    if (any(Holding::Interface) && q_.rule.interfaces == InterfaceRule::Fixed) all.push_back({"interfaces", "slide", Holding::Interface});
    if (q_.domain != nullptr) add_angles(found, all);
    if (any(Holding::Slides) && q_.max_deviation < 1.0) all.push_back(more_deviation());
    return all;
  }
  [[nodiscard]] HoldSwitch more_deviation() const {
    return {"max-deviation", fmt::format("{:.6g}", std::min(1.0, kMoreDeviation * q_.max_deviation)), Holding::Deviation};
  }

  /// "4 7": those that a person made corners.
  [[nodiscard]] std::string made_corners(const HeldMinimum& found) const {
    std::string text;
    for (const HeldVertex& one : found.vertices)
      if (one.by == Holding::Corner && q_.rule.kinds.has_corner(one.vertex))
        text += fmt::format("{}{}", text.empty() ? "" : " ", one.vertex);
    return text;
  }

  /// The least angles that would make something else of the vertices, and the greatest.
  void add_angles(const HeldMinimum& found, std::vector<HoldSwitch>& all) const {
    std::set<double> turns, folds;
    for (const HeldVertex& one : found.vertices) {
      const bool on_edge = one.by == Holding::Slides && q_.domain->on_curve(one.vertex);
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
        if (angle > now) all.push_back({name, fmt::format("{:g}", angle), frees});
    };
    add("corner-angle", turns, q_.rule.corner_angle, Holding::Corner);
    add("feature-angle", folds, q_.rule.feature_angle, Holding::Feature);
  }
  /// Where the edges of curves at a vertex lead to: of the boundary or an interface in a plane, else feature edges.
  [[nodiscard]] std::vector<Index> along_curves(Index v) const {
    const SlidingFaces& faces = q_.domain->faces();
    std::map<Index, std::vector<Index>> beside;  // by neighbour: the elements or faces at the edge
    const auto add = [&](std::span<const Index> c, Index of) {
      const auto i = static_cast<std::size_t>(std::ranges::find(c, v) - c.begin());
      for (const std::size_t other : {(i + 1) % c.size(), (i + c.size() - 1) % c.size()}) beside[c[other]].push_back(of);
    };
    if (faces.any())
      for (const Index f : faces.at(v)) add(faces.table().corners(f), f);
    else
      for (const Incidence& at : q_.input->topology.star(v)) add(mesh_.elements.corners(at.element), at.element);
    std::vector<Index> found;
    for (const auto& [other, at] : beside) {
      const bool along =
          faces.any() ? q_.domain->is_feature(v, other) : at.size() == 1 || q_.input->interfaces.between(at.front(), at.back());
      if (along) found.push_back(other);
    }
    return found;
  }
  /// By how many degrees a curve of the input turns at a vertex.
  [[nodiscard]] double turn(Index before, Index v, Index after) const {
    const Plane& plane = q_.input->geometry.plane;
    const auto& at = mesh_.positions;
    return angle_between(plane.difference(at[v], at[before]), plane.difference(at[after], at[v]));
  }
  /// By how many degrees the surface of the input folds along an edge; none where other than two facets meet.
  [[nodiscard]] std::optional<double> fold(Index a, Index b) const {
    if (!q_.domain->faces().any() || !q_.domain->faces().are_own()) return std::nullopt;
    const Facets& facets = q_.domain->faces().facets();
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
    if (change.name == "interfaces") then.rule.interfaces = InterfaceRule::Slide;
    if (change.name == "corner-angle") then.rule.corner_angle = std::stod(change.value);
    if (change.name == "feature-angle") then.rule.feature_angle = std::stod(change.value);
    if (change.name == "auto-corner") std::erase_if(then.rule.kinds.corners, is_corner);
    if (change.name == "max-deviation") then.max_deviation = std::stod(change.value);
    if (change.name == "unfix") std::erase_if(then.by_hand, is_corner);
  }
  /// The least quality of what is judged, after switches; as bad as can be where they are not possible.
  [[nodiscard]] double after_switches(std::span<const HoldSwitch> changes) const {
    Conditions then{q_.rule, q_.max_deviation, {q_.by_hand.begin(), q_.by_hand.end()}};
    for (const HoldSwitch& change : changes) apply(change, then);
    std::shared_ptr<const Domain> made;
    const Domain* domain = q_.domain;
    if (then.rule != q_.rule) {
      made = q_.domains ? q_.domains(then.rule) : domain_for(*q_.input, then.rule);
      domain = made.get();
    }
    return after(then, domain);
  }
  [[nodiscard]] SmoothingTask task_of(const Conditions& then, const Domain* domain, std::span<const Index> free) const {
    SmoothingTask task;
    task.method = q_.method;
    task.input = q_.input;
    task.colouring = std::make_shared<const Colouring>(colour_vertices(mesh_, q_.input->topology, free));
    task.metric = q_.metric;
    task.search = q_.search;
    task.search.precision = Precision::Float;  // of gains that a person would call none, double finds more, at ten times the cost
    task.slides = lets_slide(*q_.input, then.rule);
    task.domain = std::shared_ptr<const Domain>(std::shared_ptr<const Domain>(), domain);  // borrowed: it outlives the trial
    task.max_deviation = then.max_deviation * q_.input->geometry.size;
    return task;
  }
  [[nodiscard]] double after(const Conditions& then, const Domain* domain) const {
    std::vector<std::uint8_t> fixed = standing_vertices(*q_.input, then.rule, domain);
    for (const Index v : then.by_hand) fixed[v] = 1;
    std::vector<Index> free;
    for (const Index v : visited_)
      if (fixed[v] == 0) free.push_back(v);
    const SmoothingTask task = task_of(then, domain, free);
    std::vector<Vec3> positions(q_.positions.begin(), q_.positions.end());
    try {
      const auto smoother = make_smoother(task);
      smoother->positions_replaced();
      for (int round = 0; round < kRounds; ++round) {
        smoother->begin({static_cast<std::uint64_t>(round)});
        if (smoother->visit(0, task.colouring->order.size(), positions, nullptr) == 0) break;
      }
      smoother->store(positions, nullptr);
    } catch (const UsageError&) {  // such as a mesh in which nothing slides
      return -std::numeric_limits<double>::infinity();
    }
    double least = std::numeric_limits<double>::infinity();
    for (const Index e : judged_) {
      const double quality = quality_of(positions, e);
      if (!std::isnan(quality)) least = std::min(least, quality);
    }
    return least;
  }

  /// Says what keeps it in one word.
  void settle(HeldMinimum& found) const {
    if (found.change) {
      found.by = found.change->frees;
      for (HeldVertex& one : found.vertices)
        if (one.by == Holding::Slides &&
            (found.by == Holding::Deviation || (found.by == Holding::Feature && q_.domain->on_curve(one.vertex))))
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
    if (!found.rises()) look_into_visits(found);
  }

  /// Whether what the vertices on a surface could gain is refused to them.
  void look_into_visits(HeldMinimum& found) const {
    const SmoothingTask task = task_of({q_.rule, q_.max_deviation, {}}, q_.domain, {});
    for (HeldVertex& one : found.vertices) {
      if (one.by != Holding::Slides || !q_.domain->on_surface(one.vertex) || q_.method != "dmo") continue;
      const VisitEnd end = trace_surface_visit(task, q_.positions, one.vertex, {}).trace.end;
      if (end == VisitEnd::Leans) one.by = Holding::Tilt;
      if (end == VisitEnd::Deviates) one.by = Holding::Deviation;
      if (one.by != Holding::Slides) found.by = one.by;
    }
  }

  const HeldQuestion& q_;
  const Mesh& mesh_;
  Index element_;
  std::span<const std::uint8_t> standing_;
  ThreadPool* pool_;
  std::vector<Index> judged_, visited_;
};

/// The worst element of all, and of those with a corner that is not fixed; kNoIndex: there is none.
std::pair<Index, Index> worst_elements(const HeldQuestion& question, ThreadPool* pool) {
  const Mesh& mesh = question.input->mesh;
  std::vector<double> qualities(mesh.elements.size());
  element_qualities(question.input->quality_context(), question.positions, question.metric, pool, qualities);
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
  const std::vector<std::uint8_t> standing = standing_vertices(*question.input, question.rule, question.domain);
  HeldMinimum found = Look(question, worst, standing, pool).find(progress, go_on);
  if (found.change || movable == kNoIndex || movable == worst || found.rises()) return found;
  const bool stays = std::ranges::all_of(found.vertices, [](const HeldVertex& one) { return is_fixed(one.by); });
  if (!stays) return found;
  HeldMinimum next = Look(question, movable, standing, pool).find(progress, go_on);
  next.ceiling = {found.element, found.quality};
  return next;
}

}  // namespace dmoscope
