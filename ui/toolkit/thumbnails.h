#pragma once
// Small pictures of the samples for the start page: the samples themselves, made small.

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

/// One for each generator; without polygons where a generator makes nothing that small, or `pictures` are not wanted: they take some 0.1 s.
[[nodiscard]] std::vector<Thumbnail> make_thumbnails(render::ColourMap map, bool pictures = true);

}  // namespace dmoscope::ui
