#pragma once
// Parameters of a run, and the table of them: command line, commands, session files, titles and the window's panel loop over the rows. A
// new parameter is a field where it is read, and a row.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/interfaces.h"
#include "core/quality/defined_metric.h"
#include "core/quality/metric.h"
#include "core/reference/standing.h"
#include "core/run/phases.h"
#include "core/search/parameters.h"
#include "core/smooth/execution/accelerator.h"
#include "core/smooth/execution/method_table.h"
#include "core/transfer/field_rules.h"

namespace dmoscope {

/// Order in which an iteration visits the free vertices, before colouring.
struct VisitOrder {
  std::optional<std::uint64_t> seed;  // none: natural; else shuffled with this seed
  friend bool operator==(const VisitOrder&, const VisitOrder&) = default;
};

/// Words of an order: "natural" or "shuffle:SEED".
[[nodiscard]] std::string to_text(const VisitOrder& order);
/// Reads the words of to_text(). Throws UsageError.
[[nodiscard]] VisitOrder parse_order(std::string_view word);

struct RunParameters {
  std::string method = "dmo";
  Metric metric = Metric::MeanRatio;
  SearchParameters search{};
  MethodOptions options{};
  std::optional<CompositeTerms> combination{};   // a second aim besides `metric`, the first
  std::optional<PhaseBegin> then_joint{};        // a phase of joint moves after the method's
  std::optional<PhaseBegin> then_mean{};         // a phase that raises a mean, the last one
  MeanKind mean = MeanKind::Harmonic;            // the mean that phase raises
  std::optional<GuardRule> guard = GuardRule{};  // the metric that falls no further, whatever is raised
  VisitOrder order{};
  std::vector<Index> fixed{};  // the user's fixed set, besides boundary and unused vertices and, as `interfaces` says, those on interfaces
  InterfaceRule interfaces = InterfaceRule::Fixed;
  BoundaryRule boundary = BoundaryRule::Fixed;
  LayerRule layers = LayerRule::Keep;                   // rule for boundary layers, unless a target is given
  double corner_angle = StandingRule{}.corner_angle;    // degrees; where the boundary slides
  double feature_angle = StandingRule{}.feature_angle;  // degrees; where the boundary of a volume slides
  Kinds kinds{};                                        // kinds of vertices and edges that the user sets against the angles
  double joint_gap = JointOptions{}.gap;                // gap of joint moves, see JointOptions::gap
  double max_deviation = 1e-3;                          // limit for the boundary, as a share of the diagonal of the mesh's box
  double fit = 0.0;     // mesh units; vertices so near the surface of another mesh are drawn to it first; 0: none
  FieldRules fields{};  // treatment of nodal fields when the mesh is written
  Backend backend = Backend::Auto;
  friend bool operator==(const RunParameters&, const RunParameters&) = default;
  [[nodiscard]] StandingRule standing() const;
};

enum class ParameterKind { Whole, Real, Choice, Text };

struct ParameterInfo {
  std::string_view name;   // its command, its option ("--name") and its key in session files: "grid"
  std::string_view title;  // its title in the window: "grid points"
  std::string_view type;   // its type in help: "N", "float|double"
  std::string_view doc;    // one sentence for help, without a full stop
  ParameterKind kind = ParameterKind::Text;
  double least = 0.0, most = 0.0;                     // range of numbers; for Real, `least` is not in it
  std::span<const std::string_view> choices{};        // words of a Choice
  bool MethodInfo::*reader = nullptr;                 // flag of the methods that read it; null: all do
  bool joint_only = false;                            // has no effect where vertices are not moved jointly
  bool volume_only = false;                           // has no effect on planar meshes
  bool sliding_only = false;                          // has no effect where no vertex slides
  bool (*condition)(const RunParameters&) = nullptr;  // further condition under which it is read; null: always
  std::string (*to_text)(const RunParameters&);
  /// Sets the parameter. Throws UsageError for words that are no such value. The range is checked where it is read.
  void (*from_text)(RunParameters&, const std::string&);
  std::string (*in_title)(const RunParameters&) = nullptr;  // its words in a run's title where it is not the default; null: nothing
  std::string_view before{};  // its value in session files written before it existed; empty: all files have it
  std::string_view said{};    // its command, where another one has its name
  std::string_view item{};    // its widget in the window, where that is not the name
  bool in_session = true;     // is a command, and saved; else an option of the command line alone

  [[nodiscard]] std::string_view command() const noexcept { return said.empty() ? name : said; }
  /// Returns whether the run reads it. `surface`: whether the mesh is a curved surface, where all vertices slide whatever the rule says.
  [[nodiscard]] bool read_by(const RunParameters& parameters, bool surface) const;
  /// Help of a parameter: `doc`, with the range of a number and, where not all methods read it, those that do.
  [[nodiscard]] std::string help() const;
};
/// Table of all parameters that are said in one word; method, metric, objectives and fixed vertices have words of their own.
[[nodiscard]] std::span<const ParameterInfo> parameter_table();
/// Row of this name. Throws UsageError.
[[nodiscard]] const ParameterInfo& parameter_info(std::string_view name);

/// Gives the metric a target, and the second one of a combination. Throws UsageError.
void aim_at(RunParameters& parameters, const Target& target);
/// Sentence on the metric's targets: "targets: 1204 elements of layers as they were, ...".
[[nodiscard]] std::string target_sentence(const InputMesh& input, Metric metric);

/// Sets the phases after the method's: "joint", a MeanKind's name, both with a comma between them, or "nothing". Throws UsageError.
void set_then(RunParameters& parameters, std::string_view words, const PhaseBegin& begin);
/// Makes the first phase end no sooner than it would alone.
void be_patient(RunParameters& parameters, std::uint64_t patience);
/// Words that set_then() reads.
[[nodiscard]] std::string then_words(const RunParameters& parameters);
/// Later phases in words: ", then joint, then mean"; empty where the method's phase is the only one.
[[nodiscard]] std::string then_text(const RunParameters& parameters);

/// Parameters that tell a run from others by the same method and aims: ", grid 16, shuffle:3"; empty where there are none. `surface`: see
/// read_by.
[[nodiscard]] std::string other_than_usual(const RunParameters& parameters, bool surface);

}  // namespace dmoscope
