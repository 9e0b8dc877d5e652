#pragma once
// Lines under a broader casing, in the plane or in space.

#include <vector>

#include "render/style.h"

namespace dmoscope::ui {

/// All casings come first, so that none covers a line: the lines themselves are added at the end of this object's life.
template <class Marks>
class CasedLines {
 public:
  using Line = typename decltype(Marks::lines)::value_type;
  using Point = decltype(Line::from);
  CasedLines(Marks& marks, render::Rgba ink, render::Rgba casing) : marks_(marks), ink_(ink), casing_(casing) {}
  ~CasedLines() { marks_.lines.insert(marks_.lines.end(), inner_.begin(), inner_.end()); }
  CasedLines(const CasedLines&) = delete;
  CasedLines& operator=(const CasedLines&) = delete;
  void add(Point from, Point to, float width, float casing_width) {
    marks_.lines.push_back({from, to, casing_width, casing_});
    inner_.push_back({from, to, width, ink_});
  }
  /// `back` leads from the tip to the head's middle, `side` from there to one of its ends.
  void add_arrow(Point from, Point tip, Point back, Point side, float width, float casing_width) {
    add(from, tip, width, casing_width);
    add(tip, tip + back + side, width, casing_width);
    add(tip, tip + back - side, width, casing_width);
  }

 private:
  Marks& marks_;
  render::Rgba ink_, casing_;
  std::vector<Line> inner_;
};

}  // namespace dmoscope::ui
