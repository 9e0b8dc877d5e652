#pragma once
// The findings of one experiment of the paper.

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/common/line_plot.h"
#include "app/pictures/mesh_picture.h"

namespace dmoscope::app {

enum class Verdict {
  Holds,       // within the tolerance of the claim
  Differs,     // outside the tolerance of the claim
  Told,        // a figure beside the paper's, without a claim
  NoMesh,      // the mesh is missing
  NotPossible  // impossible in this version, or on this machine
};
[[nodiscard]] std::string_view name(Verdict verdict);

/// A claim of the paper (or, if it is silent, of the methods' definition) about a value, and the tolerance for ours.
struct Claim {
  std::string paper;              // the paper's words
  std::optional<double> value{};  // the claim as a number, for the difference from ours
  double lowest = -std::numeric_limits<double>::infinity(), highest = std::numeric_limits<double>::infinity();
  std::string why{};  // a sentence: the reason for a difference
  [[nodiscard]] static Claim at_least(std::string paper, double bound, std::string why = {}) {
    return {std::move(paper), {}, bound, std::numeric_limits<double>::infinity(), std::move(why)};
  }
  [[nodiscard]] static Claim at_most(std::string paper, double bound, std::string why = {}) {
    return {std::move(paper), {}, -std::numeric_limits<double>::infinity(), bound, std::move(why)};
  }
  [[nodiscard]] static Claim about(double value, double tolerance, std::string why = {});
  [[nodiscard]] bool holds(double ours) const { return ours >= lowest && ours <= highest; }
  /// The tolerance in words: "at least 0.812", "0.56 to 0.6".
  [[nodiscard]] std::string tolerance() const;
};

/// Row of the table.
struct Finding {
  std::string figure, mesh, what, paper;
  double ours = std::numeric_limits<double>::quiet_NaN();
  std::optional<double> difference{};
  std::string tolerance{};  // tolerance of the claim; empty without one
  Verdict verdict = Verdict::Told;
  std::string why{};
};

struct Figure {
  std::string id, title;
  std::vector<Finding> findings{};
  std::vector<std::pair<std::string, LinePlot>> plots{};  // by names of their files
  std::vector<std::pair<std::string, MeshPicture>> pictures{};
  std::string pictured_metric{};
  std::vector<std::string> notes{};

  /// Adds a row for a claim, with the verdict on our value.
  void check(std::string mesh, std::string what, double ours, Claim claim);
  /// Adds a row that claims nothing. `paper`: may be empty.
  void tell(std::string mesh, std::string what, double ours, std::string paper, std::string why);
  /// Adds a row for an experiment that could not be done.
  void lack(std::string mesh, std::string what, Verdict verdict, std::string why);
};

}  // namespace dmoscope::app
