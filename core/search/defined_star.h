#pragma once
// The star of a vertex for the plain search by a defined metric (a formula or a target): its elements know their quality.

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "core/formula/evaluator.h"
#include "core/mesh/mesh_view.h"
#include "core/quality/defined_quality.h"
#include "core/quality/power_mean.h"
#include "core/search/grid_search.h"
#include "core/search/joined_star.h"

namespace dmoscope {

/// Placeholder for the metric in templates whose elements judge themselves: see formulas::metric_around().
inline constexpr Metric kDefinedMetric = static_cast<Metric>(0xffffffffU);

namespace formulas {
/// The formula itself decides what an inverted element is worth. The functions have no body: they say that there are such elements.
template <>
struct Formula<kDefinedMetric> {
  static constexpr bool kSeesInversion = false;
  template <class V>
  static RealOf<V> quadrilateral(const Quadrilateral<V>& q);
  template <class Ideal, class V>
  static RealOf<V> corner(V u, V v, V w, RealOf<V> jacobian);
};
}  // namespace formulas

/// Judges the elements around a vertex. A view.
template <class Frame>
class DefinedStarJudge {
 public:
  DefinedStarJudge(const DefinedJudge& by, const ElementFrames& in, std::span<const ElementKind> kinds_of, const MeshView<Frame>& view)
      : judge(by), frames(in), kinds(kinds_of), mesh(view) {}

  const DefinedJudge& judge;
  ElementFrames frames;
  std::span<const ElementKind> kinds;
  MeshView<Frame> mesh;

  /// Writes the quality of each element of the star, in its order, as quality() returns it.
  void qualities(PositionView positions, Index vertex, Vec3 place, std::vector<double>& out) const {
    const auto star = mesh.star(vertex);
    const auto at = [&](Index v) { return v == vertex ? place : positions[v]; };
    out.resize(star.size());
    std::array<DefinedJudge::Placed, kMostAtOnce> placed;
    for (std::size_t i = 0; i < star.size();) {  // stretches of elements that one program judges
      const FormulaProgram& program = judge.program_for(star[i].element, kinds[star[i].element], star[i].corner);
      std::size_t n = 0;
      for (; i + n < star.size() && n < placed.size(); ++n) {
        const Incidence& one = star[i + n];
        if (&judge.program_for(one.element, kinds[one.element], one.corner) != &program) break;
        const auto corners = mesh.corners_of(one.element);
        placed[n].element = one.element;
        frames.gather(corners, one.element, info(kinds[one.element]).dimension, at, placed[n].corners);
        placed[n].origin = origin_of_corners(frames.geometry, at(corners[0]));
      }
      judge.qualities(program, std::span(placed).first(n), out.data() + i);
      i += n;
    }
  }
  /// Writes the quality of one element of the star with its vertex at each of some places; only corners that the vertex changes count.
  void qualities(const Incidence& at, PositionView positions, Index vertex, std::span<const Vec3> places, double* out) const {
    const ElementKind kind = kinds[at.element];
    const FormulaProgram& program = judge.program_for(at.element, kind, at.corner);
    const auto corners = mesh.corners_of(at.element);
    std::array<DefinedJudge::Placed, kFormulaBatch> placed;
    for (std::size_t first = 0; first < places.size(); first += placed.size()) {
      const std::size_t n = std::min(placed.size(), places.size() - first);
      for (std::size_t i = 0; i < n; ++i) {
        const auto there = [&](Index v) { return v == vertex ? places[first + i] : positions[v]; };
        placed[i].element = at.element;
        frames.gather(corners, at.element, info(kind).dimension, there, placed[i].corners);
        placed[i].origin = origin_of_corners(frames.geometry, there(corners[0]));
      }
      judge.qualities(program, std::span(placed).first(n), out + first);
    }
  }
  /// Quality of one element of the star with its vertex at `place`; only corners that the vertex changes count.
  [[nodiscard]] double quality(const Incidence& at, PositionView positions, Index vertex, Vec3 place) const {
    return defined_quality_at(
        judge, frames, kinds[at.element], mesh.corners_of(at.element), at.element,
        [&](Index v) { return v == vertex ? place : positions[v]; }, at.corner);
  }

 private:
  static constexpr std::size_t kMostAtOnce = 16;
};

/// The elements of a star, in the order of its lists: simplices first. Owns the data of its views.
template <class Frame>
class DefinedStar {
 public:
  using Offset = OffsetIn<Frame, double>;

  /// Gathers the star. `follower`: a vertex that moves by the same offset, whose elements come after those of `vertex`; kNoIndex: none.
  DefinedStar(const DefinedStarJudge<Frame>& judge, PositionView positions, Index vertex, Index follower = kNoIndex)
      : judge_(judge), positions_(positions), vertex_(vertex), follower_(follower), here_(positions[vertex]) {
    gather();
  }

  [[nodiscard]] double scale() const { return star_.scale; }
  [[nodiscard]] const auto& star() const { return star_; }
  [[nodiscard]] const DefinedStarJudge<Frame>& judge() const { return judge_; }
  [[nodiscard]] PositionView positions() const { return positions_; }
  [[nodiscard]] Index vertex() const { return vertex_; }
  [[nodiscard]] Index follower() const { return follower_; }

  /// An element of the star. E: StarTriangle<double> and so on.
  template <class E>
  struct Element : E {
    const DefinedStar* owner;
    std::size_t number;  // number in the order of the lists

    /// The element's shape with the star's vertex at an offset.
    template <class S>
    struct Shape : S {
      const Element* element;
      Offset p;
      Shape(const S& plain, const Element& of, Offset offset) : S(plain), element(&of), p(offset) {}
      [[nodiscard]] const S& shape() const { return *this; }
      [[nodiscard]] double own_quality() const { return element->owner->quality(element->number, p); }
    };
    [[nodiscard]] auto with(Offset p) const {
      const auto shape = E::with(p);
      return Shape<std::remove_const_t<decltype(shape)>>(shape, *this, p);
    }
  };

  /// A view of the star with the interface of StarView. Valid while the star exists.
  class View {
   public:
    explicit View(const DefinedStar& star) : star_(&star) {}
    template <bool Others, class F>
    void for_each(F f) const {
      std::size_t i = 0;
      plain(star_->star_).template for_each<true>([&]<class E>(const E& element) { f(Element<E>{{element}, star_, i++}); });
    }

   private:
    static auto plain(const Star<double>& star) { return StarView<double>(star); }
    static auto plain(const VolumeStar<double>& star) { return VolumeStarView<double>(star); }
    static auto plain(const SurfaceStar& star) { return SurfaceStarView(star); }
    const DefinedStar* star_;
  };
  [[nodiscard]] View view() const { return View(*this); }

  /// A trace for grid_search() (see NoTrace) that tells the star the candidates of a level in advance, so that it judges an element at all
  /// of them when its quality is first asked for.
  class Levels : public NoTrace {
   public:
    explicit Levels(const DefinedStar& star) : star_(star) {}
    ~Levels() { star_.level_.places.clear(); }
    Levels(const Levels&) = delete;
    Levels& operator=(const Levels&) = delete;
    void level(const CandidateGrid<double, Offset>& grid) { star_.begin(grid); }
    void candidate(int /*index*/, const Offset& /*offset*/, double /*objective*/) { ++star_.level_.candidate; }
    void found(const Candidate<double, Offset>& /*best*/) { star_.level_.places.clear(); }

   private:
    const DefinedStar& star_;
  };

  /// Announces to the star, while it exists, that only these places will be asked for, in any order, each after take(): the star then
  /// judges an element at all of them when its quality is first asked for.
  class Listed {
   public:
    Listed(const DefinedStar& star, std::span<const Offset> offsets) : star_(star) {
      for (const Offset& p : offsets) star_.level_.places.push_back(star_.place(p));
      star_.forget();
    }
    ~Listed() { star_.level_.places.clear(); }
    Listed(const Listed&) = delete;
    Listed& operator=(const Listed&) = delete;
    void take(std::size_t i) { star_.level_.candidate = i; }

   private:
    const DefinedStar& star_;
  };

  /// Quality of an element with the vertex at an offset, in units of scale(); during a level of Levels at its next candidate.
  [[nodiscard]] double quality(std::size_t number, Offset p) const {
    if (level_.places.empty()) return quality_at(order_[number], place(p));
    std::vector<double>& known = level_.qualities[number];
    if (known.empty()) {
      known.resize(level_.places.size());
      qualities_at(order_[number], level_.places, known.data());
    }
    return known[level_.candidate];
  }
  /// Least quality of the star at an offset; kInverted if an element is inverted there, which is below any metric.
  [[nodiscard]] double least(Offset p) const {
    const Vec3 there = place(p);
    double least = std::numeric_limits<double>::max();
    for (const Around& one : order_) {
      if (!(jacobian(one, there) > 0.0)) return kInverted;
      least = std::min(least, quality_at(one, there));
    }
    return std::max(least, kInverted);
  }
  /// Least qualities of the star at some offsets; one that is at most `enough` may come out greater than it is, but never above `enough`.
  void least(std::span<const Offset> offsets, double enough, double* out) const {
    thread_local std::vector<Vec3> places;  // static, so that a visit allocates nothing
    thread_local std::vector<std::size_t> left;
    thread_local std::vector<double> qualities;
    left.resize(offsets.size());
    for (std::size_t i = 0; i < offsets.size(); ++i) left[i] = i, out[i] = std::numeric_limits<double>::max();
    for (const Around& one : order_) {
      places.clear();
      std::size_t kept = 0;
      for (const std::size_t i : left) {
        const Vec3 there = place(offsets[i]);
        if (!(jacobian(one, there) > 0.0)) {
          out[i] = kInverted;
          continue;
        }
        left[kept++] = i;
        places.push_back(there);
      }
      left.resize(kept);
      qualities.resize(kept);
      qualities_at(one, places, qualities.data());
      kept = 0;
      for (std::size_t k = 0; k < left.size(); ++k) {
        const std::size_t i = left[k];
        out[i] = std::min(out[i], qualities[k]);
        if (out[i] > enough) left[kept++] = i;
      }
      left.resize(kept);
    }
    for (std::size_t i = 0; i < offsets.size(); ++i) out[i] = std::max(out[i], kInverted);
  }
  static constexpr double kInverted = -1e9;
  [[nodiscard]] double mean(Offset p, MeanKind kind) const {
    PowerMean<double> mean(kind);
    for (const Around& one : order_) mean.add(quality_at(one, place(p)));
    return mean.value(static_cast<double>(order_.size()));
  }
  /// Means of the star at some offsets, if the least there is neither inverted nor below `least`; else -infinity.
  void means(std::span<const Offset> offsets, MeanKind kind, double least, double* out) const {
    thread_local std::vector<Vec3> places;  // static, so that a visit allocates nothing
    thread_local std::vector<std::size_t> left;
    thread_local std::vector<double> qualities;
    thread_local std::vector<PowerMean<double>> means;
    means.assign(offsets.size(), PowerMean<double>(kind));
    left.clear(), places.clear();
    for (std::size_t i = 0; i < offsets.size(); ++i) left.push_back(i), places.push_back(place(offsets[i]));
    std::fill_n(out, offsets.size(), -std::numeric_limits<double>::infinity());
    for (const Around& one : order_) {
      qualities.resize(left.size());
      qualities_at(one, places, qualities.data());
      std::size_t kept = 0;
      for (std::size_t k = 0; k < left.size(); ++k) {
        if (qualities[k] < least || !(jacobian(one, places[k]) > 0.0)) continue;
        means[left[k]].add(qualities[k]);
        left[kept] = left[k], places[kept++] = places[k];
      }
      left.resize(kept), places.resize(kept);
    }
    for (const std::size_t i : left) out[i] = means[i].value(static_cast<double>(order_.size()));
  }

 private:
  /// The candidates of a level, and the qualities known there by element; no places: no level is announced.
  struct Level {
    std::vector<Vec3> places;
    std::size_t candidate = 0;
    std::vector<std::vector<double>> qualities;
  };
  void begin(const CandidateGrid<double, Offset>& grid) const {
    level_.places.clear();
    for (int i = 0; i < grid.points; ++i) grid.for_slice(i, [this](int /*index*/, const Offset& p) { level_.places.push_back(place(p)); });
    forget();
  }
  void forget() const {
    level_.candidate = 0;
    level_.qualities.resize(order_.size());
    for (auto& known : level_.qualities) known.clear();
  }
  /// An element, and which of its vertices moves.
  struct Around {
    Incidence at;
    Index vertex;
  };
  /// Position of an element's moving vertex for the star's vertex at `there`.
  [[nodiscard]] Vec3 place_of(const Around& one, Vec3 there) const {
    return one.vertex == vertex_ ? there : positions_[one.vertex] + (there - here_);
  }
  [[nodiscard]] double quality_at(const Around& one, Vec3 there) const {
    return judge_.quality(one.at, positions_, one.vertex, place_of(one, there));
  }
  void qualities_at(const Around& one, std::span<const Vec3> places, double* out) const {
    if (one.vertex == vertex_) return judge_.qualities(one.at, positions_, vertex_, places, out);
    thread_local std::vector<Vec3> followed;  // static, so that a visit allocates nothing
    followed.clear();
    for (const Vec3& there : places) followed.push_back(place_of(one, there));
    judge_.qualities(one.at, positions_, one.vertex, followed, out);
  }
  /// The least Jacobian of an element's corners that change with the vertex.
  [[nodiscard]] double jacobian(const Around& one, Vec3 there) const {
    const Vec3 moved = place_of(one, there);
    const auto at = [&](Index v) { return v == one.vertex ? moved : positions_[v]; };
    return visit_shape(judge_.mesh.frame_of(one.at.element), judge_.mesh.corners_of(one.at.element), at,
                       [&](const auto& shape) { return formulas::smallest_jacobian_around(shape, one.at.corner); });
  }
  [[nodiscard]] Vec3 place(Offset p) const {
    const Offset offset = times(p, star_.scale);
    if constexpr (std::is_same_v<Frame, Curved>)
      return here_ + offset.v;
    else
      return here_ + judge_.mesh.frame.lift(offset);
  }

  void gather() {
    gather_star_with(judge_.mesh, positions_, vertex_, follower_, star_);
    const auto list_of_element = [this](const Around& one) {
      const std::size_t corners = judge_.mesh.corners_of(one.at.element).size();
      if constexpr (!std::is_same_v<Frame, Space>) return corners;  // for triangles and quadrilaterals
      return corners == 4 ? 0 : corners == 8 ? 1 : corners == 6 ? 2 : one.at.corner < 4 ? 3 : std::size_t{4};
    };
    for (const Index v : {vertex_, follower_}) {
      if (v == kNoIndex) continue;
      for (const Incidence& at : judge_.mesh.star(v)) order_.push_back({at, v});
    }
    std::stable_sort(order_.begin(), order_.end(),
                     [&](const Around& a, const Around& b) { return list_of_element(a) < list_of_element(b); });
  }

  using Gathered = std::conditional_t<std::is_same_v<Frame, Plane>, Star<double>,
                                      std::conditional_t<std::is_same_v<Frame, Space>, VolumeStar<double>, SurfaceStar>>;
  DefinedStarJudge<Frame> judge_;
  PositionView positions_;
  Index vertex_, follower_;
  Vec3 here_;
  Gathered star_;
  std::vector<Around> order_;  // elements in the order of the lists
  mutable Level level_;
};

}  // namespace dmoscope
