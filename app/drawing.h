#pragma once
// A picture as lines, dots and words, for whatever writes pictures. In app because only verbs write plots: the window draws its own.

#include <cstdint>
#include <string>
#include <vector>

namespace dmoscope::app {

struct DrawingColour {
  std::uint8_t r = 0, g = 0, b = 0;
};

/// Lengths are in units of which one is about a pixel of a screen; x to the right, y downwards, from the left upper corner.
struct Drawing {
  struct Point {
    double x = 0.0, y = 0.0;
  };
  struct Line {
    std::vector<Point> points;
    DrawingColour colour;
    double width = 1.0;
    double dash = 0.0;  // length of a dash and of the gap after it; 0: solid
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
  std::vector<Line> lines;
  std::vector<Disc> discs;    // over the lines
  std::vector<Label> labels;  // over all
};

/// The drawing on white as SVG text.
[[nodiscard]] std::string svg_of(const Drawing& drawing);

}  // namespace dmoscope::app
