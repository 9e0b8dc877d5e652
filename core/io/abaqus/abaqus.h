#pragma once
// Interfaces that the parts of Abaqus' input format (.inp), which CalculiX reads as well, share.
// https://docs.software.vt.edu/abaqusv2024/English/ (Keywords; Elements: node ordering and face numbering)

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/cell_table.h"
#include "core/io/format.h"
#include "core/io/numbered_mesh.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

inline constexpr std::size_t kAbaqusNumber = 20;  // greatest number of characters of a real number; CalculiX cuts longer ones
inline constexpr std::string_view kAbaqusNodeSet = "node set", kAbaqusElementSet = "element set", kAbaqusSurface = "surface";

/// Meaning of an element type's name ("C3D8R", "S4"). With neither a shape nor a higher order the type is no element of a mesh.
struct AbaqusType {
  std::optional<CellShape> shape;
  bool higher_order = false;
};
[[nodiscard]] AbaqusType abaqus_type(std::string_view name);

/// Writer, see FormatHandler: nodes, elements, sets and surfaces; no materials or steps. Throws OutputError, Cancelled.
Notes write_abaqus(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

// Sets and surfaces of an Abaqus file, and the groups made of them.

/// Numbers of nodes or elements in the form that the file has: ranges.
class AbaqusSet {
 public:
  struct Range {
    std::int32_t first, last, step;
    friend auto operator<=>(const Range&, const Range&) = default;
  };
  void add(std::int32_t number);
  void add(Range range) { ranges_.push_back(range); }
  void add(const AbaqusSet& other);
  /// Removes repeated ranges.
  void tidy();
  [[nodiscard]] const std::vector<Range>& ranges() const noexcept { return ranges_; }

 private:
  std::vector<Range> ranges_;
};

class AbaqusSets {
 public:
  enum class Of { Nodes, Elements };
  /// The set of a name, created if it is new; case does not distinguish names. `scope`: where the file defines it, the part ("") or the
  /// assembly. `shown`: whether it becomes a group.
  AbaqusSet& set(Of of, std::string_view scope, std::string_view name, bool shown);
  /// The set of a name; null if there is none. A name with its instance before it (Part-1-1.Set) is also found without that.
  [[nodiscard]] const AbaqusSet* find(Of of, std::string_view scope, std::string_view name) const;

  struct SurfaceItem {
    AbaqusSet set;
    std::string side;  // side such as "S1", "SPOS", "E2"; upper case
  };
  struct Surface {
    std::string name;
    bool of_nodes = false;
    std::vector<SurfaceItem> items;
  };
  Surface& add_surface(std::string name, bool of_nodes);

  /// Makes groups of all sets and surfaces, in the order of the file. `types`: element types by origin: cells of fewer dimensions than the
  /// mesh's elements that are in no set become groups by their type. `elements`: the element of every cell, kNoIndex if it is none.
  void add_groups(const NumberedMesh& numbered, std::span<const Index> elements, std::span<const std::string> types, Mesh& mesh,
                  SourceFile& source) const;

 private:
  struct Named {
    std::string name;
    Of of;
    bool shown;
    AbaqusSet set;
  };
  struct Entry {
    const Named* set;
    const Surface* surface;
  };
  std::deque<Named> sets_;
  std::deque<Surface> surfaces_;
  std::map<std::pair<Of, std::string>, Named*> by_name_;  // by scope and name in capitals
  std::vector<Entry> entries_;
};

/// Key of a name, without its quotes; in capitals if it had none.
[[nodiscard]] std::string abaqus_key(std::string_view name);

}  // namespace dmoscope
