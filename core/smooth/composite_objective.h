#pragma once
// Composite objectives of two aims (paper, Section 4.2), a first metric up to a threshold and beyond it a second aim, and their notation,
// which is the same on the command line, in the command language and in saved sessions.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "core/base/vec.h"
#include "core/quality/metric.h"

namespace dmoscope {

/// Size function, h of the paper's eq. (7): the size that elements shall have, up to a factor common to all of the mesh.
struct SizeFunction {
  enum class Kind {
    Distance,         // h1, eq. (12): the distance to `point`
    InverseDistance,  // h2 = 1 / h1, eq. (13)
    Constant,         // everywhere the same
    Field             // `field`, a nodal field of the mesh's file, read at the position of the vertex, not carried along with it
  };
  Kind kind = Kind::Constant;
  Vec3 point{};         // in mesh coordinates
  std::string field{};  // name of the nodal field
  [[nodiscard]] bool has_point() const noexcept { return kind == Kind::Distance || kind == Kind::InverseDistance; }
  friend bool operator==(const SizeFunction&, const SizeFunction&) = default;
};

inline constexpr std::string_view kDensity = "density";  // the usual one of place_aims()

/// Value of a star for a vertex (paper eq. 8): its least first metric where that is no more than the threshold; beyond the threshold all
/// stars are better than those below, and the second aim counts: the least of another metric, or how near the vertex is to a place that it
/// wants, as for the density (eq. 6, 7).
struct CompositeTerms {
  double threshold = 0.7;
  std::variant<Metric, SizeFunction> second = SizeFunction{};
  std::string_view place = kDensity;  // name of a row of place_aims(), where the second aim is no metric
  [[nodiscard]] const SizeFunction* size() const noexcept { return std::get_if<SizeFunction>(&second); }  // null: it is a metric
  [[nodiscard]] std::string_view second_name() const;                                                     // notation of the second aim
  [[nodiscard]] std::string size_text() const;  // notation of the size function; empty where none belongs to it
  friend bool operator==(const CompositeTerms&, const CompositeTerms&) = default;
};

/// Notation of a size function: "constant", "h1:X,Y", "h2:X,Y" (",Z" where that is not 0), "field:NAME".
[[nodiscard]] std::string to_text(const SizeFunction& size);
/// Reads a size function. Throws UsageError that says what is possible.
[[nodiscard]] SizeFunction parse_size_function(std::string_view text);

/// Notation of a combination: "mean-ratio:0.7:density", "mean-ratio:0.7:min-angle"; the size function is apart.
[[nodiscard]] std::string to_text(Metric first, const CompositeTerms& combination);
/// Reads a combination; `size`: its size function, empty: everywhere the same; it must be empty where the second aim is a metric. Throws
/// UsageError, also as validate() does.
[[nodiscard]] std::pair<Metric, CompositeTerms> parse_composite(std::string_view text, std::string_view size = {});

/// A metric whose least in a star falls neither below the floor nor, where it is below that, any further, whatever else is raised.
struct Guard {
  Metric metric;
  double floor;
  friend bool operator==(const Guard&, const Guard&) = default;
};
/// Guard as it is asked for.
struct GuardRule {
  Metric metric = Metric::MeanRatio;
  std::optional<double> floor{};  // none: the least quality of the input's elements that can move
  friend bool operator==(const GuardRule&, const GuardRule&) = default;
};
/// Words of a guard: "mean-ratio:input", "scaled-jacobian:0.2"; "off" for none.
[[nodiscard]] std::string to_text(const std::optional<GuardRule>& rule);
/// Reads the words of to_text(). Throws UsageError.
[[nodiscard]] std::optional<GuardRule> parse_guard(std::string_view text);

/// Phrase for titles: "mean-ratio > 0.7 · density h1".
[[nodiscard]] std::string phrase(Metric first, const CompositeTerms& combination);

/// Throws UsageError for combinations that no mesh can have: by the threshold, the point, or the same metric twice.
void validate(Metric first, const CompositeTerms& combination);

}  // namespace dmoscope
