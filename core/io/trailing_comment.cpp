#include <algorithm>
#include <array>

#include "core/io/commented_mesh.h"

namespace dmoscope {
namespace {

struct Comment {
  std::string_view format, begin, end;
};
/// Comments by format. PLY and VTK have them in the head only, STL has none; in a fort.14 further ADCIRC input may follow the boundaries.
constexpr std::array<Comment, 7> kComments{{{"off", "# ", "\n"},
                                            {"obj", "# ", "\n"},
                                            {"su2", "% ", "\n"},
                                            {"tetgen", "# ", "\n"},
                                            {"gmsh", "$Comments\n", "\n$EndComments\n"},
                                            {"vtu", "<!-- ", " -->\n"},
                                            {"vtp", "<!-- ", " -->\n"}}};

}  // namespace

std::string trailing_comment(std::string_view format, std::string_view comment) {
  const auto* const found = std::ranges::find(kComments, format, &Comment::format);
  if (found == kComments.end()) return {};
  std::string text(comment);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F || c == '$') c = ' ';
  if (format == "vtu" || format == "vtp")
    for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 1)) text[at + 1] = ' ';
  return std::string(found->begin) + text + std::string(found->end);
}

}  // namespace dmoscope
