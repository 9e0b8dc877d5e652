#include "tests/io/meshio.h"

#include <cstdio>
#include <memory>
#include <sstream>

#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

/// Prints for each file "points N", then "kind number size" for each kind of cell, then "end".
constexpr std::string_view kScript = R"(
import sys
try:
    import meshio, numpy
except ImportError:
    print("none"); sys.exit()
faces = {"triangle": [(0, 1, 2)], "quad": [(0, 1, 2, 3)],
         "tetra": [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)],
         "hexahedron": [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
         "wedge": [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
         "pyramid": [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]}
def size(corners, kind):
    total = 0.0
    for face in faces[kind]:
        at = [corners[i] - corners[0] for i in face]
        middle = sum(at) / len(at)
        for i in range(len(at)):
            n = numpy.cross(at[i], at[(i + 1) % len(at)])
            total += n[2] / 2 if len(faces[kind]) == 1 else numpy.dot(middle, n) / 6
    return total
for name in sys.argv[1:]:
    try:
        mesh = meshio.read(name)
        points = numpy.array([list(p) + [0.0] * (3 - len(p)) for p in mesh.points])
        print("points", len(points))
        for block in mesh.cells:
            if block.type in faces:
                print(block.type, len(block.data), repr(float(sum(size(points[c], block.type) for c in block.data))))
    except (Exception, SystemExit) as error:
        print("points", 0)
        print(name, error, file=sys.stderr)
    print("end")
)";

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::string text;
  char part[4096];
  while (pipe) {
    const std::size_t got = std::fread(part, 1, sizeof part, pipe.get());
    if (got == 0) break;
    text.append(part, got);
  }
  return text;
}

}  // namespace

std::optional<std::vector<MeshioFile>> read_by_meshio(const std::vector<std::filesystem::path>& files) {
  const TemporaryFolder folder;
  put(folder / "read.py", kScript);
  std::string command = "/usr/bin/python3 '" + (folder / "read.py").string() + "'";
  for (const auto& file : files) command += " '" + file.string() + "'";
  std::istringstream text(output_of(command + " 2>'" + (folder / "errors").string() + "'"));
  std::vector<MeshioFile> found;
  std::string word;
  // meshio prints warnings among the lines
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    words >> word;
    if (word == "points") {
      words >> found.emplace_back().points;
    } else if (word != "end" && !found.empty()) {
      std::size_t number = 0;
      double size = 0.0;
      if (!(words >> number >> size)) continue;
      found.back().sizes[word] += size;
      found.back().numbers[word] += number;
    }
  }
  if (found.size() != files.size()) return std::nullopt;
  return found;
}

}  // namespace dmoscope::test
