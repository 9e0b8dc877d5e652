// Figure 9: the density of vertices follows a size function, with the mean ratio of 0.7 as threshold.

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "app/paper/lab.h"
#include "core/base/box.h"
#include "core/smooth/size_field.h"

namespace dmoscope::app {

namespace {

constexpr double kThreshold = 0.7;

Vec3 middle(const InputMesh& input) {
  const PointBox box = box_of(input.mesh.positions);
  return 0.5 * (box.low + box.high);
}

/// Correlation of the lengths of the edges at the free vertices with the sizes wanted there: of the logarithms, since sizes count up to a
/// factor.
double correlation(const SizeField& size, const InputMesh& input, std::span<const Vec3> positions) {
  std::vector<Index> free;
  for (Index v = 0; v < input.mesh.vertex_count(); ++v)
    if (input.topology.boundary()[v] == 0) free.push_back(v);
  return size_correlation(size, input, positions, free).logarithms;
}

/// Adds the findings about density. `papers`: the paper's own mesh; of another one no claim is made.
void density_on(Lab& lab, Figure& figure, const std::shared_ptr<const InputMesh>& input, bool papers) {
  const std::string mesh = input->mesh.name;
  const Vec3 point = middle(*input);
  const char* why = "The paper shows pictures alone and does not say which point; ours is the middle of the mesh.";
  lab.picture(figure, *input, input->mesh.positions, Metric::MeanRatio, "9a: " + mesh);
  for (const bool inverse : {false, true}) {
    const char* h = inverse ? "h2" : "h1";
    const SizeFunction size{.kind = inverse ? SizeFunction::Kind::InverseDistance : SizeFunction::Kind::Distance, .point = point};
    const auto run = lab.run(input, {.combination = CompositeTerms{kThreshold, size}}, lab.choose<std::uint64_t>(30, 100, 300), figure);
    if (!run) return;
    figure.check(mesh, fmt::format("{}: minimum", h), run->after.minimum,
                 Claim::at_least("0.7, the threshold", papers ? kThreshold : std::min(kThreshold, run->before().minimum),
                                 "A star that cannot reach the threshold stays below it; no star that is above falls below."));
    const SizeField field(input, size);
    const double before = correlation(field, *input, input->mesh.positions), after = correlation(field, *input, run->positions);
    figure.tell(mesh, fmt::format("{}: correlation of size and wanted size, input", h), before, "", why);
    const std::string rise = fmt::format("{}: rise of that correlation", h);
    if (papers) {
      figure.check(mesh, rise, after - before, Claim::at_least("rises", 0.2, why));
    } else {
      figure.tell(mesh, rise, after - before, "rises", why);
    }
    lab.picture(figure, *input, run->positions, Metric::MeanRatio, fmt::format("{}: {}", inverse ? "9c" : "9b", h));
  }
}

void density(Lab& lab, Figure& figure) {
  if (const auto input = lab.mesh("bahamas.14", figure)) return density_on(lab, figure, input, true);
  density_on(lab, figure, lab.stand_in("annulus 1000 1"), false);
}

}  // namespace

std::vector<Experiment> density_experiments() { return {{"9", "Density on \"bahamas\"", density}}; }

}  // namespace dmoscope::app
