// Figure 9: the density of vertices follows a size function, with the mean ratio of 0.7 as threshold.

#include <cmath>

#include <fmt/format.h>

#include "app/paper/lab.h"

namespace dmoscope::app {

namespace {

double distance(const Vec3& a, const Vec3& b) {
  const Vec3 d = a - b;
  return std::sqrt(dot(d, d));
}

Vec3 middle(const InputMesh& input) {
  Vec3 low = input.mesh.positions.front(), high = low;
  for (const Vec3& p : input.mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return 0.5 * (low + high);
}

/// How the elements' mean edges and their wanted sizes go together: Pearson's correlation of the logarithms, since the size function counts
/// up to a factor. Of elements with a free corner.
double correlation(const InputMesh& input, std::span<const Vec3> positions, const Vec3& point, bool inverse) {
  double n = 0, sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  for (Index e = 0; e < input.mesh.elements.size(); ++e) {
    const auto corners = input.mesh.elements.corners(e);
    double edges = 0.0;
    bool free = false;
    Vec3 centre{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      edges += distance(positions[corners[i]], positions[corners[(i + 1) % corners.size()]]);
      centre = centre + (1.0 / static_cast<double>(corners.size())) * positions[corners[i]];
      free = free || input.topology.boundary()[corners[i]] == 0;
    }
    if (!free) continue;
    const double size = std::log(distance(centre, point)) * (inverse ? -1.0 : 1.0);
    const double length = std::log(edges / static_cast<double>(corners.size()));
    n += 1, sx += size, sy += length, sxx += size * size, syy += length * length, sxy += size * length;
  }
  return (n * sxy - sx * sy) / std::sqrt((n * sxx - sx * sx) * (n * syy - sy * sy));
}

/// `papers`: the paper's own mesh; of another one the sizes are told, for nobody claims anything of them.
void density_on(Lab& lab, Figure& figure, const std::shared_ptr<const InputMesh>& input, bool papers) {
  const std::string mesh = input->mesh.name;
  const Vec3 point = middle(*input);
  const char* why = "The paper shows pictures alone and does not say which point; ours is the middle of the mesh.";
  lab.picture(figure, *input, input->mesh.positions, Metric::MeanRatio, "9a: " + mesh);
  for (const bool inverse : {false, true}) {
    const char* h = inverse ? "h2" : "h1";
    const SizeFunction size{.kind = inverse ? SizeFunction::Kind::InverseDistance : SizeFunction::Kind::Distance, .point = point};
    const auto run = lab.run(input, {.combination = Combination{0.7, size}}, lab.choose<std::uint64_t>(30, 100, 300), figure);
    if (!run) return;
    figure.check(mesh, fmt::format("{}: minimum", h), run->after.minimum,
                 Claim::at_least("0.7, the threshold", std::min(0.7, run->before().minimum) - 1e-9,
                                 "A star that cannot reach the threshold stays below it; no star that is above falls below."));
    const double before = correlation(*input, input->mesh.positions, point, inverse),
                 after = correlation(*input, run->positions, point, inverse);
    figure.tell(mesh, fmt::format("{}: correlation of size and wanted size, input", h), before, "", why);
    const std::string rise = fmt::format("{}: rise of that correlation", h);
    if (papers) {
      figure.check(mesh, rise, after - before, Claim::at_least("rises", 0.05, why));
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
