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
  Holds,       // what is claimed, within its tolerance
  Differs,     // it does not
  Told,        // a figure beside the paper's, of which nothing is claimed here
  NoMesh,      // its mesh is not there
  NotPossible  // not in this version, or not on this machine
};
[[nodiscard]] std::string_view name(Verdict verdict);

/// What the paper (or, where it is silent, the methods' definition) says of a value, and how far ours may be from it.
struct Claim {
  std::string paper;              // as it stands there
  std::optional<double> value{};  // the same as a number, to take a difference from
  double lowest = -std::numeric_limits<double>::infinity(), highest = std::numeric_limits<double>::infinity();
  std::string why{};  // a sentence: why ours is not the same
  [[nodiscard]] static Claim at_least(std::string paper, double bound, std::string why = {}) {
    return {std::move(paper), {}, bound, std::numeric_limits<double>::infinity(), std::move(why)};
  }
  [[nodiscard]] static Claim at_most(std::string paper, double bound, std::string why = {}) {
    return {std::move(paper), {}, -std::numeric_limits<double>::infinity(), bound, std::move(why)};
  }
  [[nodiscard]] static Claim about(double value, double tolerance, std::string why = {});
  [[nodiscard]] bool holds(double ours) const { return ours >= lowest && ours <= highest; }
  /// "at least 0.812", "0.56 to 0.6"
  [[nodiscard]] std::string tolerance() const;
};

/// A row of the table.
struct Finding {
  std::string figure, mesh, what, paper;
  double ours = std::numeric_limits<double>::quiet_NaN();
  std::optional<double> difference{};
  std::string tolerance{};  // within which it holds; empty where nothing is claimed
  Verdict verdict = Verdict::Told;
  std::string why{};
};

struct Figure {
  std::string id, title;
  std::vector<Finding> findings{};
  std::vector<std::pair<std::string, LinePlot>> plots{};  // by their files' names
  std::vector<std::pair<std::string, MeshPicture>> pictures{};
  std::string pictured_metric{};
  std::vector<std::string> notes{};

  /// Adds a row: does ours hold?
  void check(std::string mesh, std::string what, double ours, Claim claim);
  /// Adds a row that claims nothing. `paper`: may be empty.
  void tell(std::string mesh, std::string what, double ours, std::string paper, std::string why);
  /// Adds a row for what could not be done.
  void lack(std::string mesh, std::string what, Verdict verdict, std::string why);
};

}  // namespace dmoscope::app
