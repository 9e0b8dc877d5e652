#pragma once
// Sets and surfaces of an Abaqus file, and the groups that they become.

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/numbered_mesh.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Numbers of nodes or elements, as the file lists them.
class AbaqusSet {
 public:
  struct Range {
    std::int32_t first, last, step;
    friend auto operator<=>(const Range&, const Range&) = default;
  };
  void add(std::int32_t number);
  void add(Range range) { ranges_.push_back(range); }
  void add(const AbaqusSet& other);
  /// Takes out what is listed twice.
  void tidy();
  [[nodiscard]] const std::vector<Range>& ranges() const noexcept { return ranges_; }

 private:
  std::vector<Range> ranges_;
};

class AbaqusSets {
 public:
  enum class Of { Nodes, Elements };
  /// The set of a name, made if it is new; names differ by more than the case of letters. `scope`: where the file defines it, the part
  /// ("") or the assembly. `shown`: does it become a group?
  AbaqusSet& set(Of of, std::string_view scope, std::string_view name, bool shown);
  /// Null if there is none. A name with its instance before it (Part-1-1.Set) is known without, too.
  [[nodiscard]] const AbaqusSet* find(Of of, std::string_view scope, std::string_view name) const;

  struct SurfaceItem {
    AbaqusSet set;
    std::string side;  // "S1", "SPOS", "E2"; upper case
  };
  struct Surface {
    std::string name;
    bool of_nodes = false;
    std::vector<SurfaceItem> items;
  };
  Surface& add_surface(std::string name, bool of_nodes);

  /// Makes groups of all, in the order in which the file begins them. `types`: of elements by their origin: cells of fewer dimensions
  /// than the mesh's elements that are in no set become groups by their type. `elements`: the element of every cell, kNoIndex if it is
  /// none.
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
  std::map<std::pair<Of, std::string>, Named*> by_name_;  // scope and name in capitals
  std::vector<Entry> entries_;
};

/// Without its quotes; letters in capitals where it had none.
[[nodiscard]] std::string abaqus_key(std::string_view name);

}  // namespace dmoscope
