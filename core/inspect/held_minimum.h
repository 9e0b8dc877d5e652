#pragma once
// Reasons why the worst element of a mesh gets no better, and the switch that would free it.

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

/// Reason why a vertex stays in its place.
enum class Holding : std::uint8_t {
  Nothing,     // the vertex is free
  Slides,      // the vertex slides, and gains nothing more
  Deviation,   // the vertex slides, and the bound of deviation ends its way
  Tilt,        // the vertex slides, and faces would lean over the input by more than 60 degrees
  Boundary,    // the boundary is fixed
  Interface,   // the interface between materials is fixed
  Named,       // the file gives the vertex a meaning
  Corner,      // the boundary, or a feature edge, turns at the vertex by more than the corner angle
  Feature,     // feature edges meet or end at the vertex, or keep it on them
  Touching,    // parts of the mesh touch at the vertex
  Hand,        // the user fixed the vertex
  Neighbours,  // no single move gains, joint moves do
  Threshold,   // with two aims: the first does not count beyond the threshold
  Tied,        // the vertex belongs to another one, from which it would part
  Layer        // the vertex lies in a boundary layer, which is kept
};
/// Whether this reason keeps a vertex from better places.
[[nodiscard]] inline bool is_fixed(Holding by) { return by != Holding::Nothing && by != Holding::Slides; }
/// Whether a quality rose by a noticeable gain.
[[nodiscard]] inline bool is_gain(double before, double after) { return after - before > 1e-4 + 0.02 * std::abs(before); }
/// Whether a quality is as bad as another: elements that hold one another are equally bad but for the last digits.
[[nodiscard]] inline bool is_as_bad(double quality, double than) { return quality <= (1.0 + 1e-4) * than; }

/// The first entry of HeldMinimum::untried if nothing was tried.
inline constexpr std::string_view kMoreIterations = "more iterations";

/// Word of a reason for machines: "free", "slides", "boundary".
[[nodiscard]] std::string_view name(Holding holding) noexcept;
/// Phrase for a reason after "held by": "the fixed boundary".
[[nodiscard]] std::string_view phrase(Holding holding) noexcept;

struct HeldVertex {
  Index vertex = kNoIndex;
  Holding by = Holding::Nothing;
};

/// A change that the user can make: of a parameter, or of vertices fixed by hand.
struct HoldSwitch {
  std::string name, value;  // command and argument: "boundary", "slide"
  Holding frees = Holding::Nothing;
  double number = 0.0;   // the value as a number, if it is one; for "combine" the threshold
  std::string beside{};  // further word of the command: a size function
  /// Command of the switch: "boundary slide", "unfix 4 7".
  [[nodiscard]] std::string command() const { return name + ' ' + value + (beside.empty() ? "" : ' ' + beside); }
  /// Option of the switch on the command line: "--boundary slide".
  [[nodiscard]] std::string option() const;
  /// Name of the part of the mesh that the switch lets change: "the fixed boundary". Empty: none.
  [[nodiscard]] std::string gives_up() const;
};

/// Result of a short run with a switch, on a copy of the whole mesh.
struct SwitchTrial {
  double before = 0.0, after = 0.0;     // the minimum: at the start, and at its best
  std::uint64_t iterations = 0;         // number of iterations
  std::optional<std::uint64_t> from{};  // iteration at whose end the trial began, if the run does not stand there
  std::optional<double> alone{};        // minimum after as many iterations without the switch, if that rises, too
  [[nodiscard]] bool gains() const noexcept { return after - std::max(before, alone.value_or(before)) > kLeastShownGain; }
  /// Figures of the trial: "0.8035 -> 0.8062 in 20 iterations". The second number is rounded down, so that repeating it yields no less.
  [[nodiscard]] std::string figures() const;
  /// Phrase on the trial: "tried: 0.8035 -> 0.8062 in 20 iterations", "tried in 20 iterations: no gain".
  [[nodiscard]] std::string sentence() const;

 private:
  static constexpr double kLeastShownGain = 1e-4;
};

struct HeldMinimum {
  Index element = kNoIndex;                         // the worst element, or the worst that can move
  double quality = 0.0;                             // quality of the element
  std::vector<HeldVertex> vertices;                 // corners of the element
  Holding by = Holding::Nothing;                    // main reason why the element gets no better
  double unchanged = 0.0;                           // least quality around the element after some more visits without a change
  std::optional<HoldSwitch> change;                 // switch that would free the element
  std::optional<HoldSwitch> also;                   // second switch that is needed if the first alone gains nothing
  double changed = 0.0;                             // least quality around the element after some visits with these switches
  std::optional<SwitchTrial> trial{};               // result of these switches on the whole mesh, if they were tried there
  std::vector<HoldSwitch> in_vain;                  // switches that were tried and gain nothing here
  std::optional<std::pair<Index, double>> ceiling;  // an element that is worse and cannot move, and its quality
  std::shared_ptr<const JointCluster> joint;  // result of joint moves on the worst element that they can change, which may be that of the
                                              // second of two aims; null if they are impossible
  std::vector<std::string_view> untried;      // trials that were cut off: "more iterations", ...; empty: none

  /// Commands of a session that apply the switches: "continue-with boundary slide", ..., "until-converged best".
  [[nodiscard]] std::vector<std::string> advice() const;
  /// Commands of the switches that would free the element together: "boundary slide".
  [[nodiscard]] std::vector<std::string> commands() const;
  /// Options for the command line: "--feature-angle 60 --max-deviation 0.01".
  [[nodiscard]] std::string options() const;
  /// Names of all parts of the mesh that its switches let change; empty: none.
  [[nodiscard]] std::string gives_up() const;
  /// Whether there is a switch that is not known to be in vain on the whole mesh.
  [[nodiscard]] bool has_advice() const noexcept { return change && (!trial || trial->gains()); }
  /// Whether the run still raises the minimum without any change.
  [[nodiscard]] bool rises() const noexcept;
  /// Whether the worst element cannot be changed by joint moves, so that `joint` is about a better one.
  [[nodiscard]] bool is_of_another() const noexcept;
  /// Whether it is known that no joint move raises the minimum, to first order.
  [[nodiscard]] bool certified() const noexcept;
  /// Short phrase after "held by": "the fixed boundary", "nothing", "a local optimum".
  [[nodiscard]] std::string_view brief() const noexcept;
  /// Short outlook if no switch would free the element.
  [[nodiscard]] std::string outlook() const;
  /// Full text; `as_option`: with switches as the command line has them.
  [[nodiscard]] std::string sentence(bool as_option = false) const;

 private:
  [[nodiscard]] std::string hold_sentence(bool as_option) const;
  [[nodiscard]] std::string shares() const;
  [[nodiscard]] std::string tried(bool as_option) const;
  [[nodiscard]] std::string gain(bool as_option) const;
};

/// Function that returns the domain for a rule, see domain_for(): for callers that keep domains.
using DomainSource = std::function<std::shared_ptr<const Domain>(const StandingRule&)>;

/// Question about a run's minimum. The data it points to must outlive the call.
struct HeldQuestion {
  SmoothingTask task;  // task of the run; its colouring is not read
  std::span<const Vec3> positions;
  std::span<const std::uint8_t> fixed;  // see Run::fixed
  std::span<const Index> by_hand;       // vertices that the user fixed
  StandingRule rule;
  double max_deviation = 0.0;        // share of the diagonal
  Untangling untangling{};           // treatment of tangled stars by visits in the trials
  DomainSource domains{};            // empty: each domain is made anew
  bool joint = true;                 // whether joint moves are possible beside those of the run
  std::string joint_phase{};         // argument of "then" for joint moves; empty: the run has them
  std::size_t joint_at_most{};       // limit of the cluster, see joint_hold
  bool joint_where_it_rises = true;  // whether joint moves are tried even if more iterations raise the minimum
  bool certified = false;            // whether the run ended with a certificate: more iterations raise nothing, and are not tried
};

/// Examines the worst element: the reasons that keep its vertices, and the gain of each switch that concerns them. For that the vertices
/// around it are visited some times by the product's own smoother, and moved jointly, on a copy of the positions. The result is no promise
/// for the whole mesh: see try_switch(). Only possible switches are tried. If no switch frees an element that cannot move, the worst that
/// can move is examined. None for a mesh without a quality. Costs an evaluation of each element, and a Domain for each switch. A cancel,
/// and `go_on`, which is asked between two trials, end it: `untried` names the trials that were cut off.
[[nodiscard]] std::optional<HeldMinimum> held_minimum(const HeldQuestion& question, ThreadPool* pool, Progress& progress,
                                                      const std::function<bool()>& go_on = {});

}  // namespace dmoscope
