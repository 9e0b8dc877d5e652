#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/base/xml_text.h"
#include "core/io/writing/text_writer.h"
#include "core/io/xdmf/xdmf.h"

namespace dmoscope {
namespace {

class XdmfWriter {
 public:
  XdmfWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context)
      : out_(file, context), mesh_(mesh), positions_(positions) {}

  Notes write() {
    const std::string title = mesh_.title.empty() ? "Grid" : mesh_.title;
    out_ << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"" << xml_escaped(title)
         << "\" GridType=\"Uniform\">\n";
    out_ << "<Geometry GeometryType=\"XYZ\">\n<DataItem Dimensions=\"" << positions_.size()
         << " 3\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">\n";
    out_.for_each(positions_.size(), [&](TextBuffer& part, std::size_t v) {
      part << positions_[v].x << ' ' << positions_[v].y << ' ' << positions_[v].z << '\n';
    });
    out_ << "</DataItem>\n</Geometry>\n";
    topology();
    for (std::size_t i = 0; i < mesh_.fields.size(); ++i) attribute(i);
    for (std::size_t i = 0; i < mesh_.groups.size(); ++i) set(i);
    out_ << "</Grid>\n</Domain>\n</Xdmf>\n";
    out_.finish();
    Notes notes;
    note_dropped(mesh_, kept_fields_, kept_groups_, xdmf_format().info.title, notes);
    return notes;
  }

 private:
  void topology() {
    const auto kinds = mesh_.elements.kinds();
    const bool mixed = std::any_of(kinds.begin(), kinds.end(), [&](ElementKind kind) { return kind != kinds.front(); });
    const std::size_t corners = mesh_.elements.all_corners().size();
    out_ << "<Topology TopologyType=\"" << (mixed ? "Mixed" : kXdmfNames[static_cast<std::size_t>(shape_of(kinds.front()))])
         << "\" NumberOfElements=\"" << kinds.size() << "\">\n<DataItem Dimensions=\"";
    if (mixed) {
      out_ << corners + kinds.size();
    } else {
      out_ << kinds.size() << ' ' << corners / kinds.size();
    }
    out_ << "\" NumberType=\"Int\" Precision=\"8\" Format=\"XML\">\n";
    out_.for_each(kinds.size(), [&](TextBuffer& part, std::size_t i) {
      if (mixed) part << kXdmfTypes[static_cast<std::size_t>(shape_of(kinds[i]))] << ' ';
      const FileCorners of_element = file_corners(mesh_, i);
      for (std::size_t k = 0; k < of_element.size(); ++k) part << of_element[k] << (k + 1 == of_element.size() ? '\n' : ' ');
    });
    out_ << "</DataItem>\n</Topology>\n";
  }

  void attribute(std::size_t i) {
    const Field& field = mesh_.fields[i];
    const bool of_points = field.on == Field::On::Vertices;
    const std::size_t things = of_points ? positions_.size() : mesh_.elements.size();
    const auto n = static_cast<std::size_t>(field.components);
    if (field.components < 1 || field.values.size() != things * n) return;
    kept_fields_.push_back(i);
    const std::string_view type = n == 1 ? "Scalar" : n == 3 ? "Vector" : n == 6 ? "Tensor6" : n == 9 ? "Tensor" : "Matrix";
    out_ << "<Attribute Name=\"" << xml_escaped(field.name) << "\" AttributeType=\"" << type << "\" Center=\""
         << (of_points ? "Node" : "Cell") << "\">\n<DataItem Dimensions=\"" << things;
    if (n > 1) out_ << ' ' << n;
    out_ << "\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">\n";
    out_.for_each(things, [&](TextBuffer& part, std::size_t thing) {
      for (std::size_t k = 0; k < n; ++k) part << field.values[thing * n + k] << (k + 1 == n ? '\n' : ' ');
    });
    out_ << "</DataItem>\n</Attribute>\n";
  }

  void set(std::size_t i) {
    const Group& group = mesh_.groups[i];
    if ((group.dimension != 0 && !group.of_elements()) || group.members.empty()) return;
    kept_groups_.push_back(i);
    out_ << "<Set Name=\"" << xml_escaped(group.name) << "\" SetType=\"" << (group.dimension == 0 ? "Node" : "Cell")
         << "\">\n<DataItem Dimensions=\"" << group.members.size() << "\" NumberType=\"Int\" Precision=\"8\" Format=\"XML\">\n";
    out_.for_each(group.members.size(), [&](TextBuffer& part, std::size_t k) { part << group.members[k] << '\n'; });
    out_ << "</DataItem>\n</Set>\n";
  }

  TextWriter out_;
  const Mesh& mesh_;
  std::span<const Vec3> positions_;
  std::vector<std::size_t> kept_fields_, kept_groups_;
};

}  // namespace

Notes write_xdmf(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  return XdmfWriter(file, mesh, positions, context).write();
}

}  // namespace dmoscope
