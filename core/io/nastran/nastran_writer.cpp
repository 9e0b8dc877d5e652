// Writer of Nastran's bulk data: new files, and files with nodes that moved.

#include <array>
#include <atomic>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/io/mesh_writer.h"
#include "core/io/nastran/nastran.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

constexpr std::array<std::string_view, kCellShapeCount> kCards{"", "CROD", "CTRIA3", "CQUAD4", "CTETRA", "CHEXA", "CPENTA", "CPYRAM"};
constexpr std::size_t kSmall = 8;
constexpr std::size_t kMostNumber = 99999999;  // greatest number in a small field

/// Writes a GRID card in large fields, on two lines. `fields`: the number, CP, x, y, z, CD, PS and SEID.
void put_grid(TextBuffer& out, const std::array<std::string, 8>& fields, std::string_view line_end) {
  const auto line = [&](std::string_view name, std::size_t first) {
    std::string text = fmt::format("{:<8}", name);
    for (std::size_t k = first; k < first + 4; ++k) text += fmt::format("{:>16}", fields[k]);
    text.resize(text.find_last_not_of(' ') + 1);
    out << text;
  };
  line("GRID*", 0);
  out << line_end;
  line("*", 4);
  out << line_end;
}

std::string rounding_note(std::size_t rounded) {
  return fmt::format("{} coordinates were rounded to the {} characters that Nastran has for a number.", rounded, kNastranNumber);
}

class NastranWriter : MeshWriter {
 public:
  NastranWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context)
      : MeshWriter(file, mesh, positions, context, kNastranFormat.info.title, "property of lines"), file_(file) {
    number_groups();
  }

  Notes write() {
    std::size_t cells = mesh_.elements.size();
    for (const Group& group : groups_) cells += members(group);
    if (positions_.size() > kMostNumber || cells > kMostNumber) {
      throw OutputError(file_.path().string(), fmt::format("Nastran numbers {} nodes and elements at most", kMostNumber));
    }
    out_ << "CEND\n";
    if (!mesh_.title.empty()) out_ << "TITLE = " << in_quotes(mesh_.title) << '\n';
    out_ << "BEGIN BULK\n";
    names();
    nodes();
    elements();
    for (std::size_t i = 0; i < groups_.size(); ++i) cells_of(i);
    out_ << "ENDDATA\n";
    return finish();
  }

 private:
  /// Numbers the groups together, of whatever kind, as properties.
  void number_groups() {
    std::set<int> used;
    numbers_.assign(groups_.size(), 0);
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      const int code = groups_[i].code;
      if (code > 0 && code <= static_cast<int>(kMostNumber) && used.insert(code).second) numbers_[i] = code;
    }
    int next = 1;
    const auto free_number = [&] {
      while (!used.insert(next).second) ++next;
      return next;
    };
    for (int& number : numbers_) {
      if (number == 0) number = free_number();
    }
    no_group_ = free_number();
  }

  /// Number of cells that a group adds to the file.
  [[nodiscard]] static std::size_t members(const Group& group) {
    if (group.dimension == 1) return group.members.size() / 2;
    return group.dimension == 2 ? group.faces.size() : 0;
  }

  void names() {
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (members(groups_[i]) == 0 && (!groups_[i].of_elements() || groups_[i].members.empty())) continue;
      kept_groups_.push_back(i);
      if (groups_[i].name == fmt::format("property {}", numbers_[i])) continue;
      out_ << fmt::format("$HMNAME PROP{:>20}\"{}\"\n", numbers_[i], in_quotes(groups_[i].name));
    }
  }

  void nodes() {
    std::atomic<std::size_t> rounded = 0;
    out_.for_each(positions_.size(), [&](TextBuffer& part, std::size_t v) {
      std::array<std::string, 8> fields;
      fields[0] = std::to_string(v + 1);
      const std::array<double, 3> p{positions_[v].x, positions_[v].y, positions_[v].z};
      for (std::size_t k = 0; k < 3; ++k) {
        FieldNumber number = number_in_field(p[k], kNastranNumber, ExponentStyle::Sign);
        if (number.value != p[k]) ++rounded;
        fields[2 + k] = std::move(number.text);
      }
      put_grid(part, fields, "\n");
    });
    if (rounded > 0) notes_.push_back(rounding_note(rounded));
  }

  static void put_cell(TextBuffer& out, CellShape shape, std::size_t number, int property, std::span<const Index> corners) {
    std::string text = fmt::format("{:<8}{:>8}{:>8}", kCards[static_cast<std::size_t>(shape)], number, property);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (k == kSmall - 2) text += "+\n+       ";
      text += fmt::format("{:>8}", corners[k] + 1);
    }
    out << text << '\n';
  }

  void elements() {
    const std::vector<int> properties = numbers_of_elements(mesh_, numbers_, title_, notes_);
    out_.for_each(mesh_.elements.size(), [&](TextBuffer& part, std::size_t i) {
      put_cell(part, shape_of(mesh_.elements.kinds()[i]), i + 1, properties[i] == 0 ? no_group_ : properties[i], file_corners(mesh_, i));
    });
    next_ = mesh_.elements.size() + 1;
  }

  void cells_of(std::size_t i) {
    const Group& group = groups_[i];
    out_.for_each(members(group), [&](TextBuffer& part, std::size_t m) {
      if (group.dimension == 1) {
        put_cell(part, CellShape::Line, next_ + m, numbers_[i], std::span(group.members).subspan(2 * m, 2));
      } else {
        const auto face = static_cast<Index>(m);
        put_cell(part, shape_of(group.faces.kind(face)), next_ + m, numbers_[i], group.faces.corners(face));
      }
    });
    next_ += members(group);
  }

  AtomicFile& file_;
  int no_group_ = 1;      // property of elements without a group
  std::size_t next_ = 1;  // number of an element
};

/// Fields of the file's card with the coordinates that moved; the others keep their characters.
std::array<std::string, 8> moved_fields(const NastranCards& card, Vec3 before, Vec3 after, std::atomic<std::size_t>& rounded) {
  std::array<std::string, 8> fields;
  for (std::size_t k = 0; k < fields.size(); ++k) fields[k] = card.field(k);
  const std::array<double, 3> old_values{before.x, before.y, before.z}, new_values{after.x, after.y, after.z};
  for (std::size_t k = 0; k < 3; ++k) {
    if (same_bits(old_values[k], new_values[k]) && fields[2 + k].size() <= kNastranNumber) continue;
    FieldNumber number = number_in_field(new_values[k], kNastranNumber, ExponentStyle::Sign);
    if (number.value != new_values[k]) ++rounded;
    fields[2 + k] = std::move(number.text);
  }
  return fields;
}

}  // namespace

Notes write_nastran(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  return NastranWriter(file, mesh, positions, context).write();
}

Notes patch_nastran(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context) {
  constexpr std::size_t kGrain = 16384;
  const SourceFile& source = *mesh.source;
  const std::span<const Vec3> positions = moved.positions;
  const std::string_view bytes = source.bytes();
  const std::string_view line_end = bytes.find("\r\n") != std::string_view::npos ? "\r\n" : "\n";
  std::atomic<std::size_t> rounded = 0;
  TextWriter out(file, context);
  out.bytes(bytes.substr(0, source.place(0)));
  out.in_parts(source.place_count(), kGrain, [&](TextBuffer& part, std::size_t first, std::size_t last) {
    Progress unwatched;
    NastranCards cards(source, unwatched);
    for (std::size_t v = first; v < last; ++v) {
      const Vec3 p = mesh.positions[v], q = positions[v];
      const std::size_t end = v + 1 < source.place_count() ? source.place(v + 1) : bytes.size();
      if (same_bits(p.x, q.x) && same_bits(p.y, q.y) && same_bits(p.z, q.z)) {
        part << bytes.substr(source.place(v), end - source.place(v));
        continue;
      }
      cards.seek(source.place(v), 0);
      (void)cards.next();
      put_grid(part, moved_fields(cards, p, q, rounded), line_end);
      part << bytes.substr(cards.end(), end - cards.end());
    }
  });
  out.finish();
  return rounded > 0 ? Notes{rounding_note(rounded)} : Notes();
}

}  // namespace dmoscope
