#pragma once
// Two aims in one objective (paper, Section 4.2): a first metric up to a threshold, and beyond it a second aim. And how both are written:
// the same way on the command line, in the command language and in saved sessions.

#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "core/base/vec.h"
#include "core/quality/metric.h"

namespace dmoscope {

/// h of the paper's eq. (7): the size that elements shall have, up to a factor common to all of the mesh.
struct SizeFunction {
  enum class Kind {
    Distance,         // h1, eq. (12): the distance to `point`
    InverseDistance,  // h2 = 1 / h1, eq. (13)
    Constant,         // everywhere the same
    Field             // `field`, a nodal field of the mesh's file, taken where the vertex stands, not with the vertex
  };
  Kind kind = Kind::Constant;
  Vec3 point{};         // in the mesh's coordinates
  std::string field{};  // its name
  [[nodiscard]] bool has_point() const noexcept { return kind == Kind::Distance || kind == Kind::InverseDistance; }
  friend bool operator==(const SizeFunction&, const SizeFunction&) = default;
};

/// What a star is worth to a vertex (paper eq. 8): its least first metric where that is no more than the threshold; beyond the threshold
/// all stars are better than those below, and the second aim counts: the least of another metric, or the density (eq. 6, 7).
struct CompositeTerms {
  double threshold = 0.7;
  std::variant<Metric, SizeFunction> second = SizeFunction{};
  [[nodiscard]] const SizeFunction* size() const noexcept { return std::get_if<SizeFunction>(&second); }  // null: a metric
  friend bool operator==(const CompositeTerms&, const CompositeTerms&) = default;
};

/// "constant", "h1:X,Y", "h2:X,Y" (",Z" where that is not 0), "field:NAME".
[[nodiscard]] std::string to_text(const SizeFunction& size);
/// Throws UsageError that says what is possible.
[[nodiscard]] SizeFunction parse_size_function(std::string_view text);

/// "mean-ratio:0.7:density", "mean-ratio:0.7:min-angle"; the size function is apart.
[[nodiscard]] std::string to_text(Metric first, const CompositeTerms& combination);
/// The reverse; `size`: as above, empty: everywhere the same, and nothing else where the second aim is a metric. Throws UsageError, also
/// as validate() does.
[[nodiscard]] std::pair<Metric, CompositeTerms> parse_composite(std::string_view text, std::string_view size = {});

/// A metric whose least in a star falls neither below the floor nor, where it is below that, any further, whatever else is raised.
struct Guard {
  Metric metric;
  double floor;
  friend bool operator==(const Guard&, const Guard&) = default;
};

/// For titles: "mean-ratio > 0.7 · density h1".
[[nodiscard]] std::string phrase(Metric first, const CompositeTerms& combination);

/// Throws UsageError for what no mesh can have: the threshold, the point, the same metric twice.
void validate(Metric first, const CompositeTerms& combination);

}  // namespace dmoscope
