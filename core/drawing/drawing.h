#pragma once
// A picture as lines, boxes, dots and words, for whatever draws it: a file's writer, a painter of pixels, the window.

#include <cstdint>
#include <string>
#include <vector>

namespace dmoscope {

struct DrawingColour {
  std::uint8_t r = 0, g = 0, b = 0;
};

/// One unit of length is about a pixel of a screen; x to the right, y downwards, from the left upper corner. The lists are drawn over each
/// other in their order here.
struct Drawing {
  struct Point {
    double x = 0.0, y = 0.0;
  };
  struct Line {
    std::vector<Point> points;
    DrawingColour colour;
    double width = 1.0;
    double dash = 0.0;      // length of a dash and of the gap after it; 0: solid
    std::string name = {};  // what it stands for, may be empty
  };
  struct Box {
    Point from, to;  // left upper and right lower corner
    DrawingColour colour;
    double opacity = 1.0;
    std::string name = {};
  };
  struct Disc {
    Point centre;
    double radius = 1.0;
    DrawingColour colour;
  };
  enum class Anchor { Start, Middle, End };
  struct Label {
    Point at;  // on the baseline
    std::string text;
    double size = 12.0;
    DrawingColour colour;
    Anchor anchor = Anchor::Start;
  };
  double width = 0.0, height = 0.0;
  std::vector<Line> rules;  // a plot's grid
  std::vector<Box> boxes;
  std::vector<Line> lines;
  std::vector<Disc> discs;
  std::vector<Label> labels;
};

/// The drawing on white as SVG text; names become titles, which browsers show where the mouse rests.
[[nodiscard]] std::string svg_of(const Drawing& drawing);

}  // namespace dmoscope
