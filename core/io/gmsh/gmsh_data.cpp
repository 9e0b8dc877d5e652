#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/io/cell_table.h"
#include "core/io/gmsh/gmsh.h"

namespace dmoscope {

int GmshInput::whole(std::string_view what) {
  if (binary) return int_at(words.block(sizeof(std::int32_t), what).data());
  const std::int64_t value = words.integer(what);
  if (!std::in_range<int>(value)) words.fail(fmt::format("{} is too large: {}", what, value));
  return static_cast<int>(value);
}

std::int64_t GmshInput::size(std::string_view what) {
  return any_count(binary ? size_at(words.block(sizeof(std::int64_t), what).data()) : words.integer(what), what);
}

std::int64_t GmshInput::any_count(std::int64_t n, std::string_view what) const {
  if (n < 0) words.fail(fmt::format("{} is negative or too large: {}", what, n));
  return n;
}

double GmshInput::real(std::string_view what) { return binary ? real_at(words.block(sizeof(double), what).data()) : words.number(what); }

std::size_t GmshInput::count(std::string_view what, double text, double bytes) {
  const auto n = static_cast<std::size_t>(size(what));
  words.need(n, binary ? bytes : text, what);
  return n;
}

namespace {

constexpr std::size_t kReal = 8;  // size in bytes
constexpr std::int64_t kMostComponents = 1024;

}  // namespace

GmshData::Head GmshData::read_head() {
  MixedInput& words = in_.words;
  Head head;
  const std::size_t strings = words.count("the number of strings", 1.0);
  (void)words.rest_of_line();
  for (std::size_t i = 0; i < strings; ++i) {
    const std::string_view line = unquoted(words.rest_of_line());
    if (i == 0) head.name = line;
  }
  const std::size_t reals = words.count("the number of real tags", 2.0);
  double time = 0.0;
  for (std::size_t i = 0; i < reals; ++i) {
    const double value = words.number("a real tag");
    if (i == 0) time = value;
  }
  const std::size_t wholes = words.count("the number of integer tags", 2.0);
  if (wholes < 3) words.fail("3 integer tags must say step, components and number of values");
  std::array<std::int64_t, 3> tags{};
  for (std::size_t i = 0; i < wholes; ++i) {
    const std::int64_t value = words.integer("an integer tag");
    if (i < tags.size()) tags[i] = value;
    if (i == 1 && (value < 1 || value > kMostComponents))
      words.fail(fmt::format("{} components: 1 to {} are possible", value, kMostComponents));
    if (i == 2 && value < 0) words.fail(fmt::format("values of {} things", value));
  }
  head.components = static_cast<std::size_t>(tags[1]);
  head.values = static_cast<std::size_t>(tags[2]);
  const auto components = static_cast<double>(head.components);
  words.need(head.values, in_.binary ? 4.0 + 8.0 * components : 2.0 * (1.0 + components), "the number of values");
  if (time != 0.0 || tags[0] != 0) {
    source_.add_only_in_file(fmt::format("time {} and step {} of \"{}\"", time, tags[0], head.name));
    if (tags[0] != 0) head.name += fmt::format(" (step {})", tags[0]);
  }
  return head;
}

void GmshData::read(Field::On on, const TagPlaces& tags) {
  const bool of_nodes = on == Field::On::Vertices;
  const Head head = read_head();
  const std::size_t n = head.components;
  Field field{
      .name = head.name, .on = on, .components = static_cast<int>(n), .type = "double", .role = of_nodes ? "NodeData" : "ElementData"};
  const std::size_t size = tags.size() * n;
  const bool hold = size <= room_;
  if (hold) {
    room_ -= size;
    field.values.assign(size, std::numeric_limits<double>::quiet_NaN());
  } else {
    source_.add_only_in_file(fmt::format("values \"{}\" of a few nodes or elements", head.name));
  }
  in_.begin_data();
  const std::size_t each = 4 + n * kReal;
  const char* const bytes = in_.binary ? in_.words.block(head.values * each, "values").data() : nullptr;
  field.place.at = in_.binary ? 4 : 1;  // behind the node's number
  if (in_.binary) {
    field.place.begin = in_.words.token();
    field.place.bytes = static_cast<std::uint32_t>(each);
  }
  std::vector<Index> order;
  bool in_order = true;
  for (std::size_t i = 0; i < head.values; ++i) {
    const std::int64_t tag = in_.binary ? in_.int_at(bytes + i * each) : in_.words.integer("the number of a node or element");
    const Index row = tags.find(tag);
    if (i == 0 && !in_.binary) field.place.begin = in_.words.token(), field.place.words = static_cast<std::uint32_t>(n + 1);
    in_order = in_order && row == i;
    order.push_back(row);
    if (row == kNoIndex) in_.words.fail(fmt::format("values of {} {}, which the file does not have", of_nodes ? "node" : "element", tag));
    for (std::size_t k = 0; k < n; ++k) {
      const double value = in_.binary ? in_.real_at(bytes + i * each + 4 + k * kReal) : in_.words.number("a value");
      if (hold) field.values[row * n + k] = value;
    }
  }
  if (!in_order || head.values != tags.size()) field.place.rows = std::move(order);
  if (hold) fields_.push_back(std::move(field));
}

void GmshData::add_to(Mesh& mesh, std::span<const Index> rows) {
  for (Field& field : fields_) {
    const auto n = static_cast<std::size_t>(field.components);
    if (field.on == Field::On::Elements && !rows.empty()) keep_rows(field, rows);
    const auto has_none = [n](const double* row) { return std::all_of(row, row + n, [](double v) { return std::isnan(v); }); };
    std::size_t without = 0;
    for (std::size_t i = 0; i < field.values.size(); i += n) without += has_none(field.values.data() + i) ? 1 : 0;
    const std::size_t things = field.values.size() / n;
    const std::string_view plural = field.on == Field::On::Elements ? "elements" : "vertices";
    if (without == things) {
      source_.add_only_in_file(fmt::format("values \"{}\", which are of none of the mesh's {},", field.name, plural));
      continue;
    }
    if (without > 0) source_.add_note(fmt::format("Field \"{}\" has no value on {} of {} {}.", field.name, without, things, plural));
    mesh.fields.push_back(std::move(field));
  }
}

void GmshData::keep_rows(Field& field, std::span<const Index> rows) {
  std::vector<double> kept = rows_of_values(field, rows);
  const auto values = [](const std::vector<double>& list) {
    return std::count_if(list.begin(), list.end(), [](double v) { return !std::isnan(v); });
  };
  if (values(kept) != values(field.values)) source_.add_only_in_file(fmt::format("values \"{}\" on the boundary", field.name));
  field.values = std::move(kept);
}

}  // namespace dmoscope
