#include "core/mesh/materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"

namespace dmoscope {
namespace {

// Names of fields for materials, in lower-case letters and digits alone. "partition", "process" and "rank" are a computer's parts.
constexpr auto kMaterials = std::to_array<std::string_view>(
    {"material",     "materials",   "materialid",  "materialids",  "materialnumber",  "materialindex",    "matid",      "matids",
     "mat",          "matnum",      "mtr",         "region",       "regions",         "regionid",         "regionids",  "zone",
     "zones",        "zoneid",      "domain",      "domains",      "domainid",        "subdomain",        "subdomains", "subdomainid",
     "block",        "blockid",     "blockids",    "part",         "partid",          "partids",          "property",   "propertyid",
     "propertyids",  "attribute",   "attributes",  "attribute1",   "group",           "groupid",          "groupids",   "physical",
     "gmshphysical", "physicalid",  "physicalids", "celltags",     "meditref",        "objectid",         "tissue",     "tissues",
     "phaseid",      "tag",         "tags",        "label",        "labels",          "avsucdmaterial",   "tetgenref",  "flac3dgroup",
     "nastranref",   "permasgroup", "parts",       "elementblock", "elementblockids", "ansysmaterialtype"});
constexpr auto kGeometry =
    std::to_array<std::string_view>({"gmshgeometrical", "geometrical", "cellentityids", "cellentityid", "elementaryentities", "entityid",
                                     "entityids", "geometryid", "geometryids", "elementary"});
// Names of fields that hold whole numbers for the computer's parts, or for the cells themselves.
constexpr auto kOthers = std::to_array<std::string_view>(
    {"partition", "partitions", "partitionid", "gmshpartition", "process",         "processid", "processor",
     "procid",    "rank",       "mpirank",     "vtkghosttype",  "vtkghostlevels",  "celltype",  "celltypes",
     "colour",    "color",      "cellid",      "elementid",     "globalelementid", "level",     "refinement"});

std::string plain(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') letters += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) letters += c;
  }
  return letters;
}

template <class Names>
bool among(const Names& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

bool is_of_cells(const Field& field) { return field.on == Field::On::Elements && field.components == 1; }

/// Number of different whole numbers in a field, if each stands for two elements or more on average and there are `most` at most; else 0.
std::size_t count_sorting(const Field& field, std::size_t most = std::numeric_limits<std::size_t>::max()) {
  std::set<double> different;
  double last = std::nan("");
  for (const double value : field.values) {
    if (value == last) continue;
    if (value != std::floor(value) || std::abs(value) > 9e15) return 0;  // no whole number, or not finite
    last = value;
    different.insert(value);
    if (different.size() > most || (2 * different.size() > field.values.size() && different.size() > 2)) return 0;
  }
  return different.size();
}

}  // namespace

Naming naming_by_name(std::string_view field) {
  const std::string name = plain(field);
  if (among(kMaterials, name)) return Naming::Materials;
  return among(kGeometry, name) ? Naming::Geometry : Naming::Nothing;
}

Naming naming_of(const Field& field) {
  if (field.said_material) return Naming::Materials;
  if (!is_of_cells(field)) return Naming::Nothing;
  const Naming naming = naming_by_name(field.name);
  return naming != Naming::Nothing && count_sorting(field) > 0 ? naming : Naming::Nothing;
}

namespace {

[[noreturn]] void refuse_unknown(const Mesh& mesh, const std::string& name) {
  std::vector<std::string_view> known;
  for (const Field& field : mesh.fields)
    if (is_of_cells(field)) known.push_back(field.name);
  if (known.empty()) throw UsageError(fmt::format("there are no cell data '{}': the mesh has none of one number a cell", name));
  throw UsageError(unknown_value("cell data", name, known));
}

}  // namespace

void name_materials(Mesh& mesh, std::span<const std::string> names) {
  for (const std::string& name : names) {
    const auto field = std::ranges::find_if(mesh.fields, [&](const Field& f) { return is_of_cells(f) && f.name == name; });
    if (field == mesh.fields.end()) refuse_unknown(mesh, name);
    if (!std::ranges::all_of(field->values, [](double value) { return std::isfinite(value); }))
      throw UsageError(fmt::format("the cell data '{}' are no finite numbers everywhere: they cannot name materials", name));
  }
  for (Field& field : mesh.fields) field.said_material = is_of_cells(field) && among(names, field.name);
}

std::vector<std::string> said_materials(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const Field& field : mesh.fields)
    if (field.said_material && !among(names, field.name)) names.push_back(field.name);
  return names;
}

std::size_t possible_materials(const Field& field) {
  constexpr std::size_t kFew = 32;
  if (!is_of_cells(field) || naming_of(field) != Naming::Nothing || among(kOthers, plain(field.name))) return 0;
  const std::size_t different = count_sorting(field, kFew);
  return different >= 2 ? different : 0;
}

}  // namespace dmoscope
