#pragma once
// Options of smooth() and trace().

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dmoscope/export.h"
#include "dmoscope/mesh.h"
#include "dmoscope/progress.h"
#include "dmoscope/quality.h"

namespace dmo {

/// State at the end of an iteration; number 0 is the input.
struct Iteration {
  std::uint64_t number = 0;
  Statistics statistics;    // by the metric that is raised
  std::uint64_t moved = 0;  // number of vertices that moved
  double seconds = 0.0;     // time of smoothing alone
};

/// Methods of smoothing.
enum class Method {
  Dmo,            // discrete mesh optimization: the best candidate of a grid, three levels (Zint and Grosso 2018)
  Laplace,        // to the mean of the edge neighbours, whatever becomes of the cells
  SmartLaplace,   // Laplace, only where the vertex gains (Freitag 1997)
  AngleBased,     // to the places that halve the ring's angles (Zhou and Shimada 2000); not for volume meshes
  Dvr,            // directional vertex relaxation: the best place on a line (Rangarajan and Lew 2017)
  PatternSearch,  // compass search: the best of four steps, which grow or shrink (Park and Shontz 2010)
  ActiveSet,      // ascent along which none of the worst cells loses (Freitag, Jones and Plassmann 1995)
  Joint           // clusters of vertices together, by an interior point
};
/// Chains of a method and later phases.
enum class Recipe {
  None,
  Best,     // a minimum within 0.3 % of what can be reached, then the best mean that keeps it: recommended
  Hex,      // for hexahedra: shapes a third better than the worst one's, then the scaled Jacobian, then the mean
  Minimum,  // the best minimum, whatever the mean
  Mean,     // what single vertices reach, then the best mean that keeps it
  Paper     // the method of the paper alone
};
enum class Precision { Float, Double };
enum class Simd { Auto, Baseline, Avx2, Avx512 };
enum class Directions { Random, Axes };
enum class Interfaces { Fixed, Free, Slide };
enum class Layers { Keep, Free };
enum class Boundary { Fixed, Slide };
enum class Backend { Auto, Cpu, Cuda };
/// Means of the quality of all cells: "mean", "arithmetic-mean", "geometric-mean", "inverse-square-mean".
enum class MeanKind { Harmonic, Arithmetic, Geometric, InverseSquare };
/// Treatment of point data of a vertex that moves: the input's value at its new place, or its old value.
enum class FieldRule { Place, Carry };

/// Metric whose least value falls no further.
struct Guard {
  std::string metric = "mean-ratio";  // as in SmoothOptions::metric
  std::optional<double> floor;        // least value that is kept; none: that of the input's cells that can move
};

/// Second aim, which counts where the first, SmoothOptions::metric, is above a threshold.
struct SecondAim {
  double threshold = 0.7;          // above 0 and below 1
  std::string metric = "density";  // another metric, or "density", which adapts the sizes of the cells of a planar mesh
};

/// Rule for all point data, and for some by their names. Whole numbers are carried unless they have a rule of their own.
struct FieldRules {
  FieldRule all = FieldRule::Place;
  std::vector<std::pair<std::string, FieldRule>> named;  // {{"depth", FieldRule::Carry}}
};

/// Vertices by number, by name, or both.
struct Vertices {
  std::vector<Index> numbers;      // from 0 on
  std::vector<std::string> names;  // see Mesh::vertices(): "group:wall", "box:0,0,1,1", "loop:1", "3,7-9"
  [[nodiscard]] bool empty() const noexcept { return numbers.empty() && names.empty(); }
};

/// Edges of the mesh by their ends, by name, or both.
struct Edges {
  std::vector<std::array<Index, 2>> ends;  // numbers of two vertices each
  std::vector<std::string> names;          // "3-4,4-9", "group:rim" (its lines, or the border of its faces), "chain:3-4" (feature edges
                                           // from 3-4 on, both ways up to the next corner)
  [[nodiscard]] bool empty() const noexcept { return ends.empty() && names.empty(); }
};

/// Options of smooth(). Each default is that of `dmoscope smooth`. Vertices and cells count from 0; angles are in degrees; lengths are in
/// mesh units. A method ignores the options that it does not read.
struct SmoothOptions {
  // --- End of the run ---

  /// Number of iterations; an iteration visits each free vertex once. Range: 0 to 1e9. Default: 20, but a recipe goes on until converged.
  std::optional<std::uint64_t> iterations;
  /// Goes on until no vertex moves or the minimum no longer rises, and returns the best iteration. Excludes `iterations`.
  bool until_converged = false;
  /// Number of iterations without a rise of 1e-6 that count as converged; for until_converged and recipes. Range: 1 to 1e9.
  std::uint64_t patience = 200;
  /// Limit for the iterations of until_converged and recipes; a run that ends there has not converged. Range: 0 to 1e9.
  std::uint64_t max_iterations = 10000;
  /// Number of threads; 0: one for each processor. The result does not depend on it. Range: 0 to 1024.
  unsigned threads = 0;

  /// Finds what holds the minimum once the run is over: Smoothed::held. May take as long as the run. Default: false.
  bool explain = false;

  // --- Vertices and edges that are treated apart ---

  /// Vertices that stay in place, besides those of the boundary.
  Vertices fixed;
  /// Vertices of the boundary that slide, while the rest of the boundary stays.
  Vertices slide;
  /// Vertices that stay where others slide, and vertices that slide however much their curve turns there.
  Vertices corners, no_corners;
  /// Edges that nothing crosses and along which their vertices slide, and edges that are smooth however much the surface folds there.
  Edges features, no_features;
  /// Another mesh, of a curved surface or of a volume: vertices slide on its surface and along its feature edges instead of those of the
  /// mesh itself, and cells of a curved surface that face away from it are inverted. Not for planar meshes. Default: none.
  std::optional<Mesh> surface;

  // --- Aim ---

  /// Method. With a recipe: Dmo. Default: Dmo.
  Method method = Method::Dmo;
  /// Metric that is raised: a name of metrics(), a formula ("formula:2*det/norm^2"), or one with a target ("mean-ratio@input").
  std::string metric = "mean-ratio";
  /// Shape that cells are to have instead of the ideal one: "input", "field:NAME", "aspect:RATIO:DEGREES"; for groups "GROUP:SHAPE", joined
  /// by "+". Default: the metric's own.
  std::string target;
  /// Second aim, which counts beyond a threshold of `metric`. Default: none.
  std::optional<SecondAim> combine;
  /// Size that cells are to have, for a second aim of "density": "h1:X,Y" (grows with the distance from a point), "h2:X,Y" (falls with it),
  /// "constant", "field:NAME" (point data). Default: constant.
  std::string size_function;
  /// Phase of joint moves after the minimum has converged, which raises it further. Needs until_converged. Default: none.
  bool then_joint = false;
  /// Last phase, which raises this mean without lowering the minimum. Needs until_converged. Default: none.
  std::optional<MeanKind> then_mean;
  /// Method and phases under one name, instead of `method`, `combine` and the phases. Default: None.
  Recipe recipe = Recipe::None;

  // --- Parameters: fields of parameters() ---

  /// Candidates per axis of the search grid. Range: 2 to 64. Default: 8 (the paper's). Read by dmo.
  int grid = 8;
  /// Grids per visit, each finer than the one before. Range: 1 to 16. Default: 3 (the paper's). Read by dmo.
  int levels = 3;
  /// Size of the first grid in bounding boxes of the neighbouring vertices. Range: above 0, up to 2. Default: 0.5 (the paper's). Read by
  /// dmo.
  double omega = 0.5;
  /// Scalar of the search: Float or Double; moves are always confirmed in double. Default: Float. Read by dmo.
  Precision precision = Precision::Float;
  /// Vector instructions; the result is the same for any. Auto: the best that this processor has. Default: Auto. Read by dmo.
  Simd simd = Simd::Auto;
  /// Share of the way to its new place that a vertex goes. Range: above 0, up to 1. Default: 1. Read by laplace, smart-laplace,
  /// angle-based.
  double relaxation = 1.0;
  /// Directions of the lines along which vertices move, one an iteration: Random, or the Axes in turn. Default: Random. Read by dvr.
  Directions directions = Directions::Random;
  /// Seed of the random directions. Range: any whole number. Default: 1. Read by dvr.
  std::uint64_t seed = 1;
  /// Metric whose least value falls neither below its floor nor, where it is below that, any further, whatever metric is raised. Without
  /// effect if it is that metric itself, or if there are targets. None: off. Default: mean-ratio by the input. Read by all methods.
  std::optional<Guard> guard = Guard{};
  /// Seed by which the order of the visits is shuffled; none: natural. Range: any whole number. Default: natural. Read by all methods.
  std::optional<std::uint64_t> order;
  /// Vertices between groups or materials, and on inner lines and strings that the file names: Fixed, Free, or Slide (those between
  /// materials, along themselves). Default: Fixed. Read by all methods.
  Interfaces interfaces = Interfaces::Fixed;
  /// Vertices of boundary layers (stacks of at least 3 flat cells that grow from the boundary): Keep or Free. Default: Keep. Read by all
  /// methods.
  Layers layers = Layers::Keep;
  /// Vertices of the boundary: Fixed, or Slide along the boundary of the input. Default: Fixed. Read by all methods.
  Boundary boundary = Boundary::Fixed;
  /// Turn of a curve, in degrees, above which a vertex is a corner, which stays where others slide. Range: above 0, up to 180. Default: 20.
  /// Read by all methods.
  double corner_angle = 20.0;
  /// Fold of a surface, in degrees, above which an edge is a feature edge, which vertices slide along and not across. Range: above 0, up to
  /// 180. Default: 40. Read by all methods.
  double feature_angle = 40.0;
  /// Greatest distance of a sliding boundary from that of the input, as a share of the diagonal of the mesh's box. Range: above 0, up to 1.
  /// Default: 0.001. Read by all methods.
  double max_deviation = 1e-3;
  /// Distance from `surface`, in mesh units, within which vertices are drawn to it first; the boundary slides then. 0: off. Range: from 0
  /// on. Default: 0. Read by all methods.
  double fit = 0.0;
  /// Distance of a cluster's minimum from its greatest possible value at which joint moves end, as a share. Range: above 0, up to 0.5.
  /// Default: 0.0002; recipes have their own. Read by joint and the joint phase.
  double joint_gap = 2e-4;
  /// Treatment of point data of vertices that move. Default: Place for all. Read by all methods.
  FieldRules fields;
  /// Device: Auto and Cpu are the processor; Cuda is refused by the library. Default: Auto. Read by all methods.
  Backend backend = Backend::Auto;

  // --- Watching ---

  /// Called after each iteration, on the thread that called smooth(). If it returns false, smooth() ends with the result so far.
  std::function<bool(const Iteration&)> after_iteration;
  /// Progress to watch from another thread, and to cancel by.
  Progress progress;

  /// Sets an option by its name on the command line of `dmoscope smooth`, without the dashes before it, from text: set("boundary",
  /// "slide"), set("then", "mean"), set("combine", "mean-ratio:0.7:min-angle"), set("fix", "group:wall"). Throws UsageError that begins
  /// with the name.
  DMO_API void set(const std::string& name, const std::string& value);
  /// Returns the text of one of parameters(), as set() reads it. Throws UsageError.
  [[nodiscard]] DMO_API std::string get(const std::string& name) const;
};

/// Parameter of the program's table, with the words of its help.
struct Parameter {
  std::string name;                   // name for set(); with _ for - that of its field
  std::string type;                   // type in words: "N", "X", "float|double"
  std::string doc;                    // meaning
  std::string usual;                  // text of its default
  std::optional<double> least, most;  // range of a number
  bool open = false;                  // whether `least` is not in the range
  std::vector<std::string> choices;   // words of a choice; empty: any
  std::vector<std::string> methods;   // methods that read it
};
/// Returns all parameters of the table.
[[nodiscard]] DMO_API std::vector<Parameter> parameters();

}  // namespace dmo
