#pragma once
// Means of the paper's experiments: meshes, runs, and their extent.

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/common/judged_run.h"
#include "app/common/line_plot.h"
#include "app/pictures/pictures.h"

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

enum class Extent { Quick, Usual, Full };

class Lab {
 public:
  /// `meshes`: the folder of the paper's meshes, searched with its subfolders; empty: there are none. Throws InputError if it is no folder.
  Lab(std::filesystem::path meshes, Extent extent, Workshop workshop);

  [[nodiscard]] Extent extent() const noexcept { return extent_; }
  template <class T>
  [[nodiscard]] T choose(T quick, T usual, T full) const {
    return extent_ == Extent::Quick ? quick : extent_ == Extent::Usual ? usual : full;
  }
  [[nodiscard]] const Workshop& workshop() const noexcept { return workshop_; }

  /// Returns the mesh of this file name. If it is not below the folder, adds a row that says so, and returns null.
  [[nodiscard]] std::shared_ptr<const InputMesh> mesh(const std::string& file, Figure& figure);
  /// Returns a mesh that the program generates, see generate_input, named "block 10000 1, stand-in".
  [[nodiscard]] std::shared_ptr<const InputMesh> stand_in(const std::string& words);

  /// Does a run, judged by its own metric unless another one is named. If this version or this mesh has no such run, adds a row that says
  /// so, and returns none.
  [[nodiscard]] std::optional<JudgedRun> run(const std::shared_ptr<const InputMesh>& input, RunParameters parameters,
                                             std::uint64_t iterations, Figure& figure, std::optional<Metric> judge = {});
  /// Adds a picture of a mesh to a figure.
  void picture(Figure& figure, const InputMesh& input, std::span<const Vec3> positions, Metric metric, std::string caption);

 private:
  std::filesystem::path meshes_;
  Extent extent_;
  Workshop workshop_;
};

/// Experiment that fills one figure.
struct Experiment {
  std::string_view id, title;
  void (*conduct)(Lab&, Figure&);
};
/// All experiments, in the order of the paper.
[[nodiscard]] std::vector<Experiment> experiments();

[[nodiscard]] std::vector<Experiment> convergence_experiments();  // Fig. 4, and the methods on other meshes
[[nodiscard]] std::vector<Experiment> speed_experiments();        // Fig. 5, Section 5.2
[[nodiscard]] std::vector<Experiment> metric_experiments();       // Fig. 6 to 8, the mean
[[nodiscard]] std::vector<Experiment> density_experiments();      // Fig. 9
[[nodiscard]] std::vector<Experiment> order_experiments();        // Fig. 10 to 12

/// The first iteration whose minimum is at least this; none if there is none.
[[nodiscard]] std::optional<std::uint64_t> first_at_least(const JudgedRun& run, double minimum);

}  // namespace dmoscope::app
