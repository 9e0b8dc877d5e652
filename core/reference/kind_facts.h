#pragma once
// Kinds of the edges on which vertices slide, and kinds given by hand that have no effect.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/reference/domain.h"

namespace dmoscope {

enum class EdgeKind : std::uint8_t {
  Off,       // on no curve or surface that slides
  Smooth,    // vertices may cross it
  Angle,     // a feature edge, because the surface folds there
  Hand,      // a feature edge by hand
  File,      // a feature edge, because the file names it, or materials meet there
  Border,    // a feature edge, because the surface ends there
  Touching,  // a feature edge, because not exactly two faces meet there, they cannot be wound alike, or one has no normal
  Reference  // a feature edge, because the surface of another mesh, on which it slides, has one there
};
[[nodiscard]] inline bool is_feature(EdgeKind kind) noexcept { return kind > EdgeKind::Smooth; }
/// Reason why it is a feature edge: "the surface folds there". Empty for other kinds.
[[nodiscard]] std::string_view phrase(EdgeKind kind) noexcept;

/// The kind of an edge. `domain`: that of the rule.
[[nodiscard]] EdgeKind edge_kind(const InputMesh& input, const StandingRule& rule, const Domain& domain, Index a, Index b);
/// Angle by which the surface of the input folds along an edge, in degrees; none in a plane, and unless exactly two faces meet there.
[[nodiscard]] std::optional<double> fold_of(const InputMesh& input, const Domain& domain, Index a, Index b);

/// A kind given by hand that has no effect.
struct Unmet {
  std::string what;  // sentence such as "vertex 7 stays: feature edges meet there"
  bool for_good;     // for every rule of boundary and interfaces
};
/// The kinds by hand that have no effect. `said`: those of the rule's kinds to examine. `domain`: that of the rule; may be null.
[[nodiscard]] std::vector<Unmet> unmet(const InputMesh& input, const StandingRule& rule, const Domain* domain, const Kinds& said);
/// Sentence with the first of them and the number of the others.
[[nodiscard]] std::string sentence(const std::vector<Unmet>& all);
/// Sentence on the kinds in `said` that have no effect; empty if all have one. Throws UsageError if none ever has one.
[[nodiscard]] std::string require_met(const InputMesh& input, const StandingRule& rule, const Domain* domain, const Kinds& said);

}  // namespace dmoscope
