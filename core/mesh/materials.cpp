#include "core/mesh/materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

namespace dmoscope {
namespace {

// Letters and digits alone, in small letters. No "partition", "process" or "rank": those are a computer's parts.
constexpr auto kMaterials = std::to_array<std::string_view>(
    {"material",     "materials",  "materialid", "materialids", "materialnumber", "materialindex", "matid",      "matids",
     "mat",          "matnum",     "mtr",        "region",      "regions",        "regionid",      "regionids",  "zone",
     "zones",        "zoneid",     "domain",     "domains",     "domainid",       "subdomain",     "subdomains", "subdomainid",
     "block",        "blockid",    "blockids",   "part",        "partid",         "partids",       "property",   "propertyid",
     "propertyids",  "attribute",  "attributes", "attribute1",  "group",          "groupid",       "groupids",   "physical",
     "gmshphysical", "physicalid", "celltags",   "meditref",    "objectid",       "tissue",        "phaseid"});
constexpr auto kGeometry = std::to_array<std::string_view>({"gmshgeometrical", "geometrical", "cellentityids", "cellentityid",
                                                            "elementaryentities", "entityid", "entityids", "geometryid", "elementary"});

std::string plain(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') letters += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) letters += c;
  }
  return letters;
}

/// Whole numbers, of which each stands for two elements or more on average.
bool sorts_elements(const Field& field) {
  std::set<double> different;
  double last = std::nan("");
  for (const double value : field.values) {
    if (value == last) continue;
    if (value != std::floor(value) || std::abs(value) > 9e15) return false;  // also what is not finite
    last = value;
    different.insert(value);
    if (2 * different.size() > field.values.size() && different.size() > 2) return false;
  }
  return true;
}

}  // namespace

Naming naming_by_name(std::string_view field) {
  const std::string name = plain(field);
  if (std::ranges::find(kMaterials, name) != kMaterials.end()) return Naming::Materials;
  return std::ranges::find(kGeometry, name) != kGeometry.end() ? Naming::Geometry : Naming::Nothing;
}

Naming naming_of(const Field& field) {
  if (field.on != Field::On::Elements || field.components != 1) return Naming::Nothing;
  const Naming naming = naming_by_name(field.name);
  return naming != Naming::Nothing && sorts_elements(field) ? naming : Naming::Nothing;
}

}  // namespace dmoscope
