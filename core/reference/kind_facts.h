#pragma once
// Of what kind edges are where vertices slide, and what of the kinds that a person says does not come true.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/reference/domain.h"

namespace dmoscope {

enum class EdgeKind : std::uint8_t {
  Off,       // on nothing where vertices slide
  Smooth,    // vertices may cross it
  Angle,     // a feature edge, because the surface folds there
  Hand,      // because a person says so
  File,      // because the file names it, or parts materials there
  Border,    // because the surface ends there
  Touching,  // because other than two faces meet there, they cannot be wound alike, or one of them has no normal
  Reference  // because the surface of another mesh, that it slides on, has one there
};
[[nodiscard]] inline bool is_feature(EdgeKind kind) noexcept { return kind > EdgeKind::Smooth; }
/// Why it is a feature edge: "the surface folds there". Empty for others.
[[nodiscard]] std::string_view phrase(EdgeKind kind) noexcept;

/// `domain`: by the rule.
[[nodiscard]] EdgeKind edge_kind(const InputMesh& input, const StandingRule& rule, const Domain& domain, Index a, Index b);
/// By how many degrees the surface of the input folds along an edge; none in a plane, and where other than two faces meet.
[[nodiscard]] std::optional<double> fold_of(const InputMesh& input, const Domain& domain, Index a, Index b);

/// Something said that does not come true.
struct Unmet {
  std::string what;  // "vertex 7 stays: feature edges meet there"
  bool for_good;     // whatever boundary and interfaces may do
};
/// `said`: of the rule's kinds those that are asked about. `domain`: by the rule; may be null.
[[nodiscard]] std::vector<Unmet> unmet(const InputMesh& input, const StandingRule& rule, const Domain* domain, const Kinds& said);
/// The first of them and how many more there are, in one sentence.
[[nodiscard]] std::string sentence(const std::vector<Unmet>& all);
/// What of all that was said does not come true, in one sentence; empty where all does. Throws UsageError where nothing does, for good.
[[nodiscard]] std::string require_met(const InputMesh& input, const StandingRule& rule, const Domain* domain, const Kinds& said);

}  // namespace dmoscope
