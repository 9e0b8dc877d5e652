#pragma once
// What the paper's experiments work with: meshes, runs, and how much of it all is wanted.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/common/judged_run.h"
#include "app/paper/figure.h"

namespace dmoscope::app {

enum class Extent { Quick, Usual, Full };

class Lab {
 public:
  /// `meshes`: below which the paper's meshes are looked for; empty: there are none. Throws InputError when it is no folder.
  Lab(std::filesystem::path meshes, Extent extent, Workshop workshop);

  [[nodiscard]] Extent extent() const noexcept { return extent_; }
  template <class T>
  [[nodiscard]] T choose(T quick, T usual, T full) const {
    return extent_ == Extent::Quick ? quick : extent_ == Extent::Usual ? usual : full;
  }
  [[nodiscard]] const Workshop& workshop() const noexcept { return workshop_; }

  /// The mesh of this file name; where it is not below the folder, a row that says so, and null.
  [[nodiscard]] std::shared_ptr<const InputMesh> mesh(const std::string& file, Figure& figure);
  /// A mesh that the program makes, see generate_input, named "block 10000 1, stand-in".
  [[nodiscard]] std::shared_ptr<const InputMesh> stand_in(const std::string& words);

  /// A run, judged by the metric it optimises unless another is named. Where this version or this mesh has no such run, a row that says so,
  /// and none.
  [[nodiscard]] std::optional<JudgedRun> run(const std::shared_ptr<const InputMesh>& input, RunParameters parameters,
                                             std::uint64_t iterations, Figure& figure, std::optional<Metric> judge = {});
  /// Adds a picture of a mesh to a figure.
  void picture(Figure& figure, const InputMesh& input, std::span<const Vec3> positions, Metric metric, std::string caption);

 private:
  std::filesystem::path meshes_;
  Extent extent_;
  Workshop workshop_;
};

/// An experiment: the figure that it fills.
struct Experiment {
  std::string_view id, title;
  void (*conduct)(Lab&, Figure&);
};
/// All of them, in the order of the paper.
[[nodiscard]] std::vector<Experiment> experiments();

[[nodiscard]] std::vector<Experiment> convergence_experiments();  // Fig. 4, and the methods on other meshes
[[nodiscard]] std::vector<Experiment> speed_experiments();        // Fig. 5, Section 5.2
[[nodiscard]] std::vector<Experiment> metric_experiments();       // Fig. 6 to 8, the mean
[[nodiscard]] std::vector<Experiment> density_experiments();      // Fig. 9
[[nodiscard]] std::vector<Experiment> order_experiments();        // Fig. 10 to 12

/// The first iteration whose minimum is at least this; none when there is none.
[[nodiscard]] std::optional<std::uint64_t> first_at_least(const JudgedRun& run, double minimum);

}  // namespace dmoscope::app
