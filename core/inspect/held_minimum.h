#pragma once
// What keeps the worst element of a mesh from getting better, and which switch would free it.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/joint/joint_clusters.h"
#include "core/reference/domain.h"
#include "core/reference/standing.h"
#include "core/search/untangling.h"
#include "core/smooth/task.h"

namespace dmoscope {

/// What keeps a vertex where it is.
enum class Holding : std::uint8_t {
  Nothing,     // it is free
  Slides,      // it slides, and gains nothing more
  Deviation,   // it slides, and the bound of deviation ends its way
  Tilt,        // it slides, and faces would lean over the input by more than 60 degrees
  Boundary,    // the boundary stays
  Interface,   // the interface between materials stays
  Named,       // the file gives it a meaning
  Corner,      // the boundary, or a feature edge, turns there by more than the corner angle
  Feature,     // feature edges meet or end there, or keep it on them
  Touching,    // parts of the mesh touch there
  Hand,        // it was fixed by hand
  Neighbours,  // no single move gains, joint ones do
  Threshold,   // of two aims: beyond it the first does not count
  Tied,        // it belongs to another vertex, from which it would part
  Layer        // it lies in a boundary layer, which is kept
};
/// Does it keep a vertex from a place that would be better?
[[nodiscard]] inline bool is_fixed(Holding by) { return by != Holding::Nothing && by != Holding::Slides; }
/// Whether a quality rose by what a person would call a gain.
[[nodiscard]] inline bool is_gain(double before, double after) { return after - before > 1e-4 + 0.02 * std::abs(before); }
/// Elements that hold one another are equally bad but for the last digits.
[[nodiscard]] inline bool is_as_bad(double quality, double than) { return quality <= (1.0 + 1e-4) * than; }

/// The first entry of HeldMinimum::untried where nothing was tried.
inline constexpr std::string_view kMoreIterations = "more iterations";

/// For machines: "free", "slides", "boundary".
[[nodiscard]] std::string_view name(Holding holding) noexcept;
/// For people, after "held by": "the fixed boundary".
[[nodiscard]] std::string_view phrase(Holding holding) noexcept;

struct HeldVertex {
  Index vertex = kNoIndex;
  Holding by = Holding::Nothing;
};

/// What a person can change: a parameter, or vertices that are no longer fixed by hand.
struct HoldSwitch {
  std::string name, value;  // "boundary", "slide"
  Holding frees = Holding::Nothing;
  double number = 0.0;   // the value, of what is a number; of "combine" the threshold
  std::string beside{};  // what the command says besides: a size function
  /// "boundary slide", "unfix 4 7"
  [[nodiscard]] std::string command() const { return name + ' ' + value + (beside.empty() ? "" : ' ' + beside); }
  /// On the command line: "--boundary slide".
  [[nodiscard]] std::string option() const;
  /// Names the part of the mesh that the switch lets change: "the fixed boundary". Empty: none.
  [[nodiscard]] std::string gives_up() const;
};

/// Result of a short run with a switch, on a copy of the whole mesh.
struct SwitchTrial {
  double before = 0.0, after = 0.0;     // the minimum: where it began, and at its best
  std::uint64_t iterations = 0;         // that it took
  std::optional<std::uint64_t> from{};  // the iteration whose end it began with, where the run does not stand there
  std::optional<double> alone{};        // where more iterations raise the minimum, too: what as many do without the switch
  [[nodiscard]] bool gains() const noexcept { return after - std::max(before, alone.value_or(before)) > kLeastShownGain; }
  /// "0.8035 -> 0.8062 in 20 iterations". The second number is rounded down: whoever does the same gets no less.
  [[nodiscard]] std::string figures() const;
  /// "tried: 0.8035 -> 0.8062 in 20 iterations", "tried in 20 iterations: no gain"
  [[nodiscard]] std::string sentence() const;

 private:
  static constexpr double kLeastShownGain = 1e-4;
};

struct HeldMinimum {
  Index element = kNoIndex;                         // the worst element, or the worst that can move
  double quality = 0.0;                             // its
  std::vector<HeldVertex> vertices;                 // its corners
  Holding by = Holding::Nothing;                    // what keeps it, in one word
  double unchanged = 0.0;                           // the least quality around it after some more visits as things are
  std::optional<HoldSwitch> change;                 // what would free it
  std::optional<HoldSwitch> also;                   // where that alone gains nothing: what must go with it
  double changed = 0.0;                             // the same with these
  std::optional<SwitchTrial> trial{};               // what these come to on the whole mesh, where that was tried
  std::vector<HoldSwitch> in_vain;                  // what was tried and gains nothing here
  std::optional<std::pair<Index, double>> ceiling;  // an element that is worse, and that nothing moves
  std::shared_ptr<const JointCluster> joint;        // what joint moves make of the worst that they can change, which may be of the second
                                                    // of two aims; null where they cannot be
  std::vector<std::string_view> untried;            // what the look did not come to: "more iterations", ...; empty: it came to its end

  /// The commands of a session that follow the switches: "continue-with boundary slide", ..., "until-converged best".
  [[nodiscard]] std::vector<std::string> advice() const;
  /// The switches that would free it together: "boundary slide".
  [[nodiscard]] std::vector<std::string> commands() const;
  /// On the command line: "--feature-angle 60 --max-deviation 0.01".
  [[nodiscard]] std::string options() const;
  /// Names all parts of the mesh that its switches let change; empty: none.
  [[nodiscard]] std::string gives_up() const;
  /// Is there a switch that is not known to be in vain on the whole mesh?
  [[nodiscard]] bool has_advice() const noexcept { return change && (!trial || trial->gains()); }
  /// Does the run still raise it without any change?
  [[nodiscard]] bool rises() const noexcept;
  /// Is what joint moves can change better than the worst element, which they cannot?
  [[nodiscard]] bool is_of_another() const noexcept;
  /// Is it known that no joint move raises it, to first order?
  [[nodiscard]] bool certified() const noexcept;
  /// After "held by": "the fixed boundary", "nothing", "a local optimum"
  [[nodiscard]] std::string_view brief() const noexcept;
  /// Where no switch would free it, what is to be expected, in a few words.
  [[nodiscard]] std::string outlook() const;
  /// All of it in words; `as_option`: as the command line has switches.
  [[nodiscard]] std::string sentence(bool as_option = false) const;

 private:
  [[nodiscard]] std::string hold_sentence(bool as_option) const;
  [[nodiscard]] std::string shares() const;
  [[nodiscard]] std::string tried(bool as_option) const;
  [[nodiscard]] std::string gain(bool as_option) const;
};

/// Where vertices slide by a rule, see domain_for(): for those who keep domains.
using DomainSource = std::function<std::shared_ptr<const Domain>(const StandingRule&)>;

/// Of what the question is. What it points to must outlive the call.
struct HeldQuestion {
  SmoothingTask task;  // of the run; its colouring is not looked at
  std::span<const Vec3> positions;
  std::span<const std::uint8_t> fixed;  // see Run::fixed
  std::span<const Index> by_hand;       // what the user fixed
  StandingRule rule;
  double max_deviation = 0.0;        // a share of the diagonal
  Untangling untangling{};           // of visits in the trials
  DomainSource domains{};            // empty: each is made anew
  bool joint = true;                 // can there be joint moves beside what the run does?
  std::string joint_phase{};         // what "then" must be told for them; empty: the run has them
  std::size_t joint_at_most{};       // see joint_hold
  bool joint_where_it_rises = true;  // are joint moves tried, too, where more iterations raise the minimum?
  bool certified = false;            // the run ended so: more iterations raise nothing, and are not tried
};

/// Looks at the worst element: what keeps its vertices, and what each switch that concerns them would gain. For that the vertices around
/// it are visited some times by the product's own smoother, and moved jointly, on a copy of the positions. What that reaches is no promise
/// for the whole mesh: see try_switch(). Only what can be is tried. Where no switch frees an element that cannot move, it looks at the
/// worst that can. None for a mesh without a quality. Costs a look at each element, and a Domain for each switch. A cancel, and `go_on`,
/// which is asked between two trials, end the look: `untried` says what it did not come to.
[[nodiscard]] std::optional<HeldMinimum> held_minimum(const HeldQuestion& question, ThreadPool* pool, Progress& progress,
                                                      const std::function<bool()>& go_on = {});

}  // namespace dmoscope
