#pragma once
// Works out values to colour elements by instead of their quality, and which of them count. No ImGui, no OpenGL.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/view/view.h"
#include "render/colour_map.h"
#include "render/shading.h"
#include "ui/state/colouring_state.h"

namespace dmoscope::ui {

struct Category {
  std::string name;
  render::Rgb colour;
  std::size_t count = 0;  // number of elements or vertices
};

/// Values or categories that the elements of one frame are coloured by.
struct ElementColours {
  ColourBy by = ColourBy::Quality;
  std::uint64_t input_serial = 0;
  std::shared_ptr<const render::Shading> shading;
  std::string title;                      // "area / mean area"
  std::string common_title;               // title for all frames on show together
  std::string counted;                    // things that the categories count: "elements", "vertices"
  std::vector<Category> categories;       // empty: values
  std::pair<double, double> range{0, 1};  // range of the values
  bool logarithmic = false;               // the values are powers of ten
  bool centred = false;                   // 0 is the middle of the range, and of the map
  bool has_values = true;                 // some element has a value; otherwise `note` says why none has
  bool diverging = false;                 // the values are differences
  std::size_t better = 0, worse = 0;      // for differences: elements above and below 0
  std::string note;                       // remark for the user; may be empty
  std::vector<Category> beside;           // elements without a value, such as those inside
};

struct ColourRequest {
  ColourBy by = ColourBy::Kind;
  std::shared_ptr<const Frame> frame;
  std::shared_ptr<const Colouring> classes;            // colour classes, for ColourBy::Class
  render::ColourMap map = render::ColourMap::Viridis;  // map of ordered categories
  bool reversed = false;
  std::shared_ptr<const SizeField> size{};   // wanted sizes, for ColourBy::SizeOverTarget; null: the run has none
  std::shared_ptr<const Frame> reference{};  // whole frame that differences are taken from, for ColourBy::Difference
  bool comparable = true;                    // the reference has the same elements
  std::shared_ptr<const Domain> domain{};    // domain of sliding vertices, for ColourBy::Deviation, Tilt and Freedom; null: nothing slides
  SharedVector<std::uint8_t> fixed{};        // flags of fixed vertices, for ColourBy::Freedom; see Run::fixed
  std::shared_ptr<const JointCluster> hold{};  // joint move that holds the minimum, for ColourBy::Multiplier; null: not known
};

/// Whether colours depend on positions: then they are worked out for every frame, but not for a light one.
[[nodiscard]] constexpr bool needs_positions(ColourBy by) {
  return by == ColourBy::Displacement || by == ColourBy::Size || by == ColourBy::EdgeLength || by == ColourBy::SizeOverTarget ||
         by == ColourBy::Difference || by == ColourBy::Deviation || by == ColourBy::Tilt;
}

/// Whether colours take so long that even a small mesh must not wait for them.
[[nodiscard]] constexpr bool takes_long(ColourBy by) { return by == ColourBy::Deviation || by == ColourBy::Tilt; }

/// Reason why the elements of a mesh cannot be coloured so; none if they can.
[[nodiscard]] std::optional<std::string> why_not_drawn(ColourBy by, const InputMesh& input);

/// Whether colours would be the same all over a mesh that has just been opened, or cannot be drawn at all.
[[nodiscard]] bool tells_nothing(ColourBy by, const Frame& opened);

/// Colours of the elements of a frame. Takes some 20 ms a million elements, on any thread; kinds that takes_long() names some 5 s a million
/// faces, by many threads. `by` must not be ColourBy::Quality.
[[nodiscard]] ElementColours colour_elements(const ColourRequest& request);

/// A colour-blind safe colour for the k-th of some things without an order (Okabe and Ito 2008; lighter, then darker ones from the eighth
/// on).
[[nodiscard]] render::Rgb category_colour(std::size_t k);

}  // namespace dmoscope::ui
