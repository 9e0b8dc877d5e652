#include "app/subcommands/input_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/common/console.h"
#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/mesh/group_facts.h"
#include "core/mesh/materials.h"

namespace dmoscope::app {
namespace {

std::string_view place_of(const Field& field) { return field.on == Field::On::Elements ? "elements" : "points"; }
bool names_materials(const Field& field) { return naming_of(field) != Naming::Nothing; }

Json json_of(const std::optional<int>& number) { return number ? Json(*number) : Json(nullptr); }

}  // namespace

std::vector<std::string> tell_findings(const InputMesh& input) {
  std::vector<std::string> sentences = input.report.sentences();
  for (const std::string& sentence : sentences) complain(fmt::format("{}: {}", input.mesh.name, sentence));
  return sentences;
}

void tell_interfaces(const InputMesh& input, const RunParameters& parameters, std::vector<std::string>& warnings) {
  std::vector<std::string> sentences;
  if (parameters.standing().layers == LayerRule::Keep && !input.layers.empty()) sentences.push_back(input.layers_sentence("--layers free"));
  if (parameters.interfaces == InterfaceRule::Fixed) {
    if (std::string held = input.interfaces.sentence("--interfaces free"); !held.empty()) sentences.push_back(std::move(held));
    for (std::string& offer : input.interfaces.offers("--materials")) sentences.push_back(std::move(offer));
  }
  for (std::string& sentence : sentences) {
    complain(fmt::format("{}: {}", input.mesh.name, sentence));
    warnings.push_back(std::move(sentence));
  }
}

Kinds tell_kinds(const InputMesh& input, const RunParameters& parameters, const Selections& selections,
                 std::vector<std::string>& warnings) {
  std::vector<std::string> unmet;
  Kinds kinds = kinds_of(input, parameters, selections, unmet);
  for (std::string& sentence : unmet) {
    complain(fmt::format("{}: {}", input.mesh.name, sentence));
    warnings.push_back(std::move(sentence));
  }
  return kinds;
}

void print_groups(const Mesh& mesh, std::size_t most) {
  const std::vector<GroupFacts> groups = facts_of_groups(mesh);
  if (groups.empty()) return;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t g = 0; g < std::min(most, groups.size()); ++g) {
    const GroupFacts& group = groups[g];
    rows.push_back({group.type ? fmt::format("{} (type {})", group.kind, *group.type) : group.kind, std::to_string(group.dimension),
                    group.number ? std::to_string(*group.number) : "-", group.name, std::string(group.of), grouped(group.members),
                    grouped(group.vertices)});
  }
  print_lines("\n" + text_table({"group", "dimension", "id", "name", "of", "count", "vertices"}, rows, "lrrllrr"));
  if (groups.size() > most) print("and {} (dmoscope info FILE lists all)\n", counted(groups.size() - most, "more group", "more groups"));
}

void print_fields(const Mesh& mesh) {
  if (mesh.fields.empty()) return;
  std::vector<std::vector<std::string>> rows;
  for (const Field& field : mesh.fields) {
    rows.push_back({field.name, std::string(place_of(field)), std::to_string(field.components), field.type,
                    names_materials(field) ? "names materials" : ""});
  }
  print_lines("\n" + text_table({"data", "of", "numbers", "type", ""}, rows, "llrll"));
}

Json json_of_groups(const Mesh& mesh) {
  Json list = Json::array();
  for (const GroupFacts& group : facts_of_groups(mesh)) {
    list.push_back({{"kind", group.kind},
                    {"dimension", group.dimension},
                    {"id", json_of(group.number)},
                    {"type", json_of(group.type)},
                    {"name", group.name},
                    {"members", group.of},
                    {"count", group.members},
                    {"vertices", group.vertices}});
  }
  return list;
}

void print_outline(const Outline& outline) {
  const bool several = outline.parts.size() > 1;
  std::vector<std::vector<std::string>> loops, parts;
  for (Index l = 0; l < outline.loops.size(); ++l) {
    const BoundaryLoop& loop = outline.loops[l];
    loops.push_back({outline.name(l), grouped(loop.vertices.size()), brief(loop.length), brief(loop.area)});
    if (several) loops.back().push_back(std::to_string(loop.part + 1));
  }
  std::vector<std::string> heads{"boundary", "vertices", "length", "encloses"};
  if (several) heads.emplace_back("part");
  if (!loops.empty()) print_lines("\n" + text_table(heads, loops, several ? "lrrrr" : "lrrr"));
  for (Index p = 0; several && p < outline.parts.size(); ++p) {
    const MeshPart& part = outline.parts[p];
    parts.push_back(
        {fmt::format("part {}", p + 1), grouped(part.elements.size()), grouped(part.vertices), grouped(part.loops), brief(part.area)});
  }
  if (several) print_lines("\n" + text_table({"connected", "elements", "vertices", "loops", "area"}, parts, "lrrrr"));
  if (outline.left_out > 0)
    print("\nloops and parts leave out {}: a third one at an edge, or wound against its neighbours\n",
          counted(outline.left_out, "element", "elements"));
}

Json json_of_outline(const Outline& outline) {
  Json loops = Json::array(), parts = Json::array();
  for (Index l = 0; l < outline.loops.size(); ++l) {
    const BoundaryLoop& loop = outline.loops[l];
    loops.push_back({{"name", outline.name(l)},
                     {"part", loop.part + 1},
                     {"outer", loop.outer},
                     {"vertices", loop.vertices.size()},
                     {"length", loop.length},
                     {"area", loop.area}});
  }
  for (const MeshPart& part : outline.parts)
    parts.push_back({{"elements", part.elements.size()}, {"vertices", part.vertices}, {"loops", part.loops}, {"area", part.area}});
  return {{"boundary_loops", std::move(loops)}, {"parts", std::move(parts)}, {"left_out", outline.left_out}};
}

Json json_of_fields(const Mesh& mesh) {
  Json list = Json::array();
  for (const Field& field : mesh.fields) {
    list.push_back(
        {{"name", field.name}, {"of", place_of(field)}, {"components", field.components}, {"names_materials", names_materials(field)}});
  }
  return list;
}

}  // namespace dmoscope::app
