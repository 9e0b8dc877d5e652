#include "core/io/medit/medit_contents.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/medit/medit.h"

namespace dmoscope {

void MeditContents::reserve_cells(CellShape shape, std::size_t count) {
  cells_.reserve_more(count, count * corners_of(shape));
  if (shape == CellShape::Line) edges_.reserve(2 * count);
}

void MeditContents::add_cell(CellShape shape, const Index* corners, int reference) {
  cells_.add(shape, corners, origin_of(reference));
  if (shape == CellShape::Line) edges_.insert(edges_.end(), {corners[0], corners[1]});
}

std::uint32_t MeditContents::origin_of(int reference) {
  if (!labels_.empty() && labels_[last_origin_].labels.front().code == reference) return last_origin_;
  const auto [at, added] = origins_.try_emplace(reference, static_cast<std::uint32_t>(labels_.size()));
  if (added) labels_.push_back({{{fmt::format("reference {}", reference), std::string(kMeditReference), reference}}, reference != 0});
  return last_origin_ = at->second;
}

void MeditContents::fail_mark(const MeditMarks& marks, std::size_t i, std::size_t things, std::string_view what) const {
  throw InputError(source_.path().string(), marks.lines.empty() ? 0 : marks.lines[i],
                   fmt::format("{} {} out of range (the file has {} {})", marks.keyword, marks.numbers[i], things, what));
}

void MeditContents::make_group(const MeditMarks& marks) {
  const CellShape shape = medit_mark(marks.keyword)->of;
  if (shape >= CellShape::Triangle) return make_face_group(marks, shape);
  const bool of_edges = shape == CellShape::Line;
  const std::size_t things = of_edges ? edges_.size() / 2 : mesh.positions.size();
  Group group{.name = marks.keyword, .role = std::string(kMeditMark), .code = 0, .dimension = of_edges ? 1 : 0};
  for (std::size_t i = 0; i < marks.numbers.size(); ++i) {
    const std::int64_t number = marks.numbers[i];
    if (number < 1 || static_cast<std::uint64_t>(number) > things) fail_mark(marks, i, things, of_edges ? "edges" : "vertices");
    const auto at = static_cast<std::size_t>(number - 1);
    if (of_edges) {
      group.members.insert(group.members.end(), {edges_[2 * at], edges_[2 * at + 1]});
    } else {
      group.members.push_back(static_cast<Index>(at));
    }
  }
  if (!group.members.empty()) mesh.groups.push_back(std::move(group));
}

/// Makes a group of faces of a volume, or of elements if these are the mesh.
void MeditContents::make_face_group(const MeditMarks& marks, CellShape shape) {
  std::vector<std::size_t> begins;  // offsets of the corners of cells of this shape
  std::vector<Index> places;        // numbers of these cells
  std::size_t corner = 0;
  for (std::size_t c = 0; c < cells_.size(); corner += corners_of(cells_.shape(c)), ++c) {
    if (cells_.shape(c) != shape) continue;
    begins.push_back(corner);
    places.push_back(static_cast<Index>(c));
  }
  Group group{.name = marks.keyword, .role = std::string(kMeditMark), .code = 0, .dimension = 2};
  const bool of_elements = cells_.dimension() == 2;
  for (std::size_t i = 0; i < marks.numbers.size(); ++i) {
    const std::int64_t number = marks.numbers[i];
    if (number < 1 || static_cast<std::uint64_t>(number) > begins.size()) fail_mark(marks, i, begins.size(), info(*kind_of(shape)).plural);
    const auto at = static_cast<std::size_t>(number - 1);
    if (!of_elements) {
      group.faces.add(*kind_of(shape), cells_.all_corners().subspan(begins[at], corners_of(shape)));
    } else if (rows_.empty()) {
      group.members.push_back(places[at]);
    } else {
      group.members.push_back(static_cast<Index>(std::ranges::lower_bound(rows_, places[at]) - rows_.begin()));
    }
  }
  if (!group.members.empty() || group.faces.size() > 0) mesh.groups.push_back(std::move(group));
}

void MeditContents::add_field(Field::On on, std::vector<double> values) {
  mesh.fields.push_back(
      {.name = std::string(kMeditField), .on = on, .type = "int", .role = std::string(kMeditReference), .values = std::move(values)});
}

/// Makes elements and groups. References of elements become groups if they are few, else a field.
void MeditContents::split() {
  constexpr std::size_t kMostGroups = 256;
  std::vector<std::uint8_t> of_element(labels_.size(), 0);  // flags by origin
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (dimension_of(cells_.shape(c)) == cells_.dimension()) of_element[cells_.origin(c)] = 1;
  }
  const bool many = static_cast<std::size_t>(std::count(of_element.begin(), of_element.end(), 1)) > kMostGroups;
  if (many) {
    for (OriginLabels& labels : labels_) labels.of_elements = false;
  }
  rows_ = split_cells(cells_, labels_, mesh, source_);
  if (!many) return;
  std::vector<double> values(mesh.elements.size());
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    values[e] = labels_[cells_.origin(rows_.empty() ? e : rows_[e])].labels.front().code;
  }
  add_field(Field::On::Elements, std::move(values));
}

Mesh MeditContents::finish() {
  split();
  for (const MeditMarks& marks : marks_) make_group(marks);
  if (std::any_of(references.begin(), references.end(), [](int r) { return r != 0; })) {
    add_field(Field::On::Vertices, {references.begin(), references.end()});
  }
  return std::move(mesh);
}

}  // namespace dmoscope
