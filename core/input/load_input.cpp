#include <new>
#include <utility>

#include "core/base/error.h"
#include "core/base/words.h"
#include "core/input/input_mesh.h"
#include "core/io/mesh_io.h"
#include "core/mesh/generate.h"
#include "core/mesh/materials.h"

namespace dmoscope {

std::shared_ptr<const InputMesh> load_input(const std::filesystem::path& path, Need need, const IoContext& context,
                                            std::span<const std::string> materials) {
  try {
    Mesh mesh = read_mesh(path, context);
    name_materials(mesh, materials);
    return prepare_input(std::move(mesh), path, need, context.progress);
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
