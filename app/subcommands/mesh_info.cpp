#include "app/subcommands/mesh_info.h"

#include <array>
#include <limits>

#include "app/common/console.h"
#include "app/common/text.h"
#include "app/subcommands/group_table.h"
#include "app/subcommands/input_report.h"
#include "core/mesh/thin.h"
#include "core/target/boundary_layers.h"

namespace dmoscope::app {

namespace {

std::array<std::size_t, kElementKindCount> count_kinds(const Mesh& mesh) {
  std::array<std::size_t, kElementKindCount> counts{};
  for (const ElementKind kind : mesh.elements.kinds()) ++counts[static_cast<std::size_t>(kind)];
  return counts;
}

Json json_of(const InputMesh& input, const Mesh& mesh, const std::filesystem::path& file, const std::vector<std::string>& warnings) {
  const auto counts = count_kinds(mesh);
  const BoundaryLayers layers = find_boundary_layers(input.mesh, input.geometry);
  Json kinds = Json::object();
  for (std::size_t k = 0; k < kElementKindCount; ++k)
    if (counts[k] > 0) kinds[std::string(kElementKinds[k].plural)] = counts[k];
  return {{"input", file.string()},
          {"title", mesh.title},
          {"vertices", mesh.vertex_count()},
          {"elements", mesh.elements.size()},
          {"kinds", std::move(kinds)},
          {"groups", json_of_groups(mesh)},
          {"data", json_of_fields(mesh)},
          {"outline", json_of_outline(outline_of(input.mesh))},
          {"boundary_layers", {{"elements", layers.elements.size()}, {"stacks", layers.stacks}, {"most", layers.most}}},
          {"thin", input.mesh.thin != nullptr},
          {"held_on_interfaces", input.interfaces.count()},
          {"warnings", warnings}};
}

}  // namespace

void tell_mesh(const std::filesystem::path& file, bool json) {
  Watch watch;
  IoContext reading(watch.progress());
  reading.geographic = Geographic::Auto;
  reading.thin = Thin::Auto;
  const auto input = load_input(file, Need::QualityOnly, reading);
  const Mesh cells = input->mesh.thin ? with_cells(input->mesh) : Mesh();
  const Mesh& mesh = input->mesh.thin ? cells : input->mesh;  // the cells of the file
  const std::vector<std::string> warnings = tell_findings(*input);
  if (json) return print_json(json_of(*input, mesh, file, warnings));
  std::string kinds;
  const auto counts = count_kinds(mesh);
  for (std::size_t k = 0; k < kElementKindCount; ++k) {
    if (counts[k] == 0) continue;
    kinds += (kinds.empty() ? "" : ", ") + counted(counts[k], kElementKinds[k].name, kElementKinds[k].plural);
  }
  print("{}: {}, {}\n", mesh.name, counted(mesh.vertex_count(), "vertex", "vertices"), kinds);
  if (!mesh.title.empty()) print("{}\n", mesh.title);
  print_groups(mesh, std::numeric_limits<std::size_t>::max());
  print_fields(mesh);
  print_outline(outline_of(input->mesh));
  if (const BoundaryLayers layers = find_boundary_layers(input->mesh, input->geometry); !layers.empty())
    print("\nboundary layers: {} in {}, up to {} high ({})\n", counted(layers.elements.size(), "element", "elements"),
          counted(layers.stacks, "stack", "stacks"), layers.most,
          input->layers.empty()
              ? "--target layers:input keeps them"
              : fmt::format("{} of them stay when it is smoothed: --layers free lets them go, --target layers:input keeps "
                            "their shape",
                            counted(input->layers.size(), "vertex", "vertices")));
  if (const std::string sentence = input->interfaces.sentence("--interfaces free"); !sentence.empty())
    print("\nwhen it is smoothed, {}\n", sentence);
}

}  // namespace dmoscope::app
