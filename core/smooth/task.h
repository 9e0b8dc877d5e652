#pragma once
// Task that a smoother is made from.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "core/base/thread_pool.h"
#include "core/input/input_mesh.h"
#include "core/mesh/colouring.h"
#include "core/quality/metric.h"
#include "core/reference/standing.h"
#include "core/search/parameters.h"
#include "core/smooth/composite_objective.h"

namespace dmoscope {

class PlaceAim;

/// Directions along which dvr relaxes: one per sweep for all vertices, drawn at random from a seed; or the axes of the mesh's plane, or of
/// space, by turns.
enum class Directions { Random, Axes };
/// Name of a choice: "random" or "axes".
[[nodiscard]] std::string_view name(Directions directions);
/// Reads a name. Throws UsageError.
[[nodiscard]] Directions parse_directions(std::string_view word);

/// Options of methods other than dmo. Each reads those that concern it.
struct MethodOptions {
  double relaxation = 1.0;  // laplace, smart-laplace, angle-based: the share of the way to the new place that a vertex goes, in (0, 1]
  Directions directions = Directions::Random;  // dvr
  std::uint64_t seed = 1;                      // for dvr's random directions
  friend bool operator==(const MethodOptions&, const MethodOptions&) = default;
};

/// Throws UsageError that names the option out of range.
void validate(const MethodOptions& options);

struct SmoothingTask {
  std::string_view method = "dmo";
  std::shared_ptr<const InputMesh> input{};
  std::shared_ptr<const Colouring> colouring{};  // classes of the vertices that may move
  Metric metric = Metric::MeanRatio;
  SearchParameters search{};
  MethodOptions options{};
  std::optional<CompositeTerms> combination{};  // dmo and joint: `metric` is its first one
  std::shared_ptr<const PlaceAim> aim{};        // for a combination whose second aim is no metric
  std::optional<Guard> guard{};                 // metric that falls no further, whatever is raised
  bool then_joint = false;                      // whether a phase of joint moves may come, which is the run's
  bool then_mean = false;                       // whether a phase may come that raises the mean, see Sweep
  bool slides = false;                          // whether vertices of the boundary or of interfaces slide
  std::shared_ptr<const Domain> domain{};       // curves and facets to slide on: domain_for() the rule
  double max_deviation = 0.0;                   // limit for edges and faces against the input, in mesh units: see slide.h
  std::span<const Index> immovable{};           // see immovable_elements; for statistics on a device
  ThreadPool* pool = nullptr;
};

}  // namespace dmoscope
