#pragma once
// Pages of HTML without other files: no network, light or dark as the reader's system, well-formed as XML too.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/pictures/pictures.h"
#include "core/drawing/drawing.h"

namespace dmoscope::app {

/// A cell of a table: its text, and the value that it is sorted by ("" for no value, which comes last). A class of the page's style may be
/// named: "good", "bad", "best", "dim".
struct PageCell {
  std::string text;
  std::string key{};
  bool is_number = false;
  std::string style{};
};

/// Page that is put together part by part; all text that is given is escaped.
class Page {
 public:
  explicit Page(std::string title) : title_(std::move(title)) {}
  void heading(std::string_view text, int level = 2);
  void paragraph(std::string_view text);
  /// Adds a list of names and values.
  void facts(const std::vector<std::pair<std::string, std::string>>& facts);
  /// Adds a table whose rows are sorted by a click on a head. `hints`: a tooltip for each head, may be empty; `kept`: number of rows that
  /// stay on top in any order.
  void table(const std::vector<std::string>& head, const std::vector<std::string>& hints, const std::vector<std::vector<PageCell>>& rows,
             std::size_t kept = 0);
  /// Adds a drawing, as SVG.
  void plot(const Drawing& drawing);
  /// Adds pictures side by side, each with a caption, above the bar of their colours; in place of a missing one, the reason. `low`: the
  /// quality at the bar's left end.
  void pictures(const std::vector<std::pair<std::string, MeshPicture>>& pictures, std::string_view metric, double low = 0.0);
  /// The whole page.
  [[nodiscard]] std::string text() const;

 private:
  std::string title_, body_;
};

}  // namespace dmoscope::app
