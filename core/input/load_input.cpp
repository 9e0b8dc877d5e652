#include <new>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/words.h"
#include "core/input/input_mesh.h"
#include "core/input/prepare.h"
#include "core/io/mesh_io.h"
#include "core/mesh/generate.h"
#include "core/mesh/geographic.h"
#include "core/mesh/materials.h"
#include "core/mesh/thin.h"

namespace dmoscope {
namespace {

/// Maps a mesh that is in degrees; returns sentences for the user.
std::vector<std::string> take_degrees(Mesh& mesh, const std::filesystem::path& path, Need need, Geographic choice) {
  if (choice == Geographic::Off) return {};
  if (choice == Geographic::On) {
    if (const std::string why = why_not_geographic(mesh); !why.empty())
      throw InputError(path.string(), 0, fmt::format("it cannot be taken for longitude and latitude (--geographic on): {}", why));
  } else {
    const Likeness likeness = looks_geographic(mesh);
    if (likeness == Likeness::Range)
      return {"its coordinates may be degrees of longitude and latitude, but nothing says so: --geographic on judges it on the Earth"};
    if (likeness == Likeness::None) return {};
    if (likeness == Likeness::Pole) {
      std::string text =
          "its coordinates seem to be degrees of longitude and latitude, round the globe and up to a pole, which no map shows";
      if (need == Need::Smoothing)
        throw InputError(path.string(), 0, text + ": cut it at 89.5 degrees, or take them as they stand (--geographic off)");
      return {text + ": it is judged in the plane of its numbers"};
    }
  }
  map_to_mercator(mesh);
  return {
      "its coordinates are degrees of longitude and latitude, and it is judged on the Earth (--geographic off takes them as they stand)"};
}

/// Replaces a mesh one cell thick by that of its front; returns sentences for the user.
std::vector<std::string> take_thin(Mesh& mesh, const std::filesystem::path& path, const IoContext& context) {
  if (context.thin == Thin::Off) return {};
  if (const std::string why = take_front(mesh, context.progress); !why.empty()) {
    if (context.thin == Thin::Auto) return {};
    throw InputError(path.string(), 0, fmt::format("it cannot be taken for a mesh one cell thick (--thin on): {}", why));
  }
  return {
      "it is one cell thick, and judged and smoothed as the 2-D mesh of its front, which the back follows (--thin off takes its cells)"};
}

}  // namespace

std::shared_ptr<const InputMesh> load_input(const std::filesystem::path& path, Need need, const IoContext& context,
                                            std::span<const std::string> materials) {
  try {
    Mesh mesh = read_mesh(path, context);
    name_materials(mesh, materials);
    std::vector<std::string> notes = take_degrees(mesh, path, need, context.geographic);
    for (std::string& note : take_thin(mesh, path, context)) notes.push_back(std::move(note));
    return prepare(std::move(mesh), path, need, context.progress, {}, std::move(notes));
  } catch (const std::bad_alloc&) {
    throw InputError(path.string(), 0, "not enough memory for this mesh");
  }
}

std::shared_ptr<const InputMesh> with_materials(const InputMesh& input, std::span<const std::string> materials) {
  auto result = std::make_shared<InputMesh>(input);
  name_materials(result->mesh, materials);
  result->interfaces = Interfaces(result->mesh, result->topology);
  return result;
}

std::shared_ptr<const InputMesh> generate_input(const std::string& line, Progress& progress) {
  const std::vector<std::string> words = split_words(line);
  if (words.empty() || words.size() > 3) throw UsageError("a sample is KIND [SIZE [SEED]]");
  const std::size_t size = words.size() > 1 ? to_count(words[1]) : 0;
  const std::uint64_t seed = words.size() > 2 ? to_count(words[2]) : 1;
  return prepare_input(generate_mesh(words[0], size, seed, progress), {}, Need::Smoothing, progress, line);
}

}  // namespace dmoscope
