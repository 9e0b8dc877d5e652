#pragma once
// A picture as lines, boxes, dots and words, independent of its output: a file, pixels, the window.

#include <cstdint>
#include <string>
#include <vector>

namespace dmoscope {

struct DrawingColour {
  std::uint8_t r = 0, g = 0, b = 0;
};

/// A picture. One unit of length is about a pixel of a screen; x to the right, y downwards, from the upper left corner. The lists are drawn
/// over each other in their order here.
struct Drawing {
  struct Point {
    double x = 0.0, y = 0.0;
  };
  struct Line {
    std::vector<Point> points;
    DrawingColour colour;
    double width = 1.0;
    double dash = 0.0;      // length of a dash and of the gap after it; 0: solid
    std::string name = {};  // meaning of the line, may be empty
  };
  struct Box {
    Point from, to;  // upper left and lower right corner
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
    Point at;  // point on the baseline
    std::string text;
    double size = 12.0;
    DrawingColour colour;
    Anchor anchor = Anchor::Start;
  };
  double width = 0.0, height = 0.0;
  std::vector<Line> rules;  // grid of a plot
  std::vector<Box> boxes;
  std::vector<Line> lines;
  std::vector<Disc> discs;
  std::vector<Label> labels;
};

/// The drawing on white as SVG text; names become titles, which browsers show under the mouse.
[[nodiscard]] std::string svg_of(const Drawing& drawing);

}  // namespace dmoscope
