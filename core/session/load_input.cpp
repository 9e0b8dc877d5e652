#include "core/io/mesh_io.h"
#include "core/session/input_mesh.h"

namespace dmoscope {

std::shared_ptr<const InputMesh> load_input(const std::filesystem::path& path, Need need, const IoContext& context) {
  return prepare_input(read_mesh(path, context), path, need, context.progress);
}

}  // namespace dmoscope
