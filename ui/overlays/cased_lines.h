#pragma once
// Lines over broader casings.

#include <utility>
#include <vector>

#include "render/marks.h"

namespace dmoscope::ui {

/// Colours of lines, and of the casings below them.
struct Inks {
  render::Rgba ink, casing;
};

/// Adds casings at once and collects the lines, so that no casing covers a line: the lines themselves are added at the end of this object's
/// life.
class CasedLines {
 public:
  CasedLines(render::Marks& marks, Inks inks) : marks_(marks), inks_(inks) {}
  ~CasedLines() { marks_.lines.insert(marks_.lines.end(), inner_.begin(), inner_.end()); }
  CasedLines(const CasedLines&) = delete;
  CasedLines& operator=(const CasedLines&) = delete;
  void add(Vec3 from, Vec3 to, float width, float casing_width) {
    marks_.lines.push_back({from, to, casing_width, inks_.casing});
    inner_.push_back({from, to, width, inks_.ink});
  }

 private:
  render::Marks& marks_;
  Inks inks_;
  std::vector<render::OverlayLine> inner_;
};

}  // namespace dmoscope::ui
