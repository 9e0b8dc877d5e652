#include "core/smooth/place_aim.h"

#include <algorithm>
#include <array>

#include "core/smooth/size_field.h"

namespace dmoscope {

namespace {

using MeshPtr = std::shared_ptr<const InputMesh>;

constexpr auto kPlaceAims = std::to_array<PlaceAimInfo>({{
    .name = kDensity,
    .title = "Density",
    .doc = "element sizes by a size function: each vertex moves towards the mean of its neighbours, weighted by 1 / size",
    .sized = true,
    .make = [](const MeshPtr& input, const SizeFunction& size) -> std::shared_ptr<const PlaceAim> {
      return std::make_shared<const SizeField>(input, size);
    },
}});

}  // namespace

std::span<const PlaceAimInfo> place_aims() { return kPlaceAims; }

const PlaceAimInfo* find_place_aim(std::string_view name) {
  const auto found = std::ranges::find(kPlaceAims, name, &PlaceAimInfo::name);
  return found != kPlaceAims.end() ? &*found : nullptr;
}

}  // namespace dmoscope
