#pragma once
// Small pictures of the samples for the start page, made from small samples.

#include <array>
#include <string>
#include <vector>

#include "render/colour_map.h"

namespace dmoscope::ui {

struct Thumbnail {
  struct Polygon {
    std::array<std::array<float, 2>, 4> corners;  // 0 to 1, y down
    int count = 3;
    render::Rgb colour;
  };
  std::string name;
  std::string doc;
  std::vector<Polygon> polygons;
};

/// One thumbnail for each generator; without polygons if a generator makes nothing that small, or if `pictures` are not wanted. Pictures
/// take some 0.1 s.
[[nodiscard]] std::vector<Thumbnail> make_thumbnails(render::ColourMap map, bool pictures = true);

}  // namespace dmoscope::ui
