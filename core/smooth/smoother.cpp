#include "core/smooth/smoother.h"

#include <stdexcept>

namespace dmoscope {

void Smoother::give(std::span<const Index> /*vertices*/, std::span<const Vec3> /*positions*/, std::span<Vec3> /*places*/) const {
  throw std::logic_error("this smoother works on whole meshes alone");
}

void Smoother::take(std::span<const Index> /*vertices*/, std::span<const Vec3> /*places*/, std::span<Vec3> /*positions*/) {
  throw std::logic_error("this smoother works on whole meshes alone");
}

}  // namespace dmoscope
