#pragma once
// Lines of ADCIRC's grid file: nodes, elements and boundary strings.

#include <functional>
#include <string_view>
#include <vector>

#include "core/io/reading/source_file.h"
#include "core/io/reading/tokenizer.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// Syntax of Fortran's list-directed input; text behind the numbers of a line is a remark.
inline constexpr TextSyntax kFort14Syntax{.comma_is_blank = true};
inline constexpr std::string_view kFort14Open = "open boundary", kFort14Land = "land boundary";

struct Fort14Head {
  std::string_view title;
  std::size_t elements = 0, nodes = 0;
};
/// Reads the first two lines.
[[nodiscard]] Fort14Head read_fort14_head(Tokenizer& tokens);

/// A node from its line; `place`: the offset of its coordinates.
struct Fort14Node {
  std::int64_t number = 0;
  Vec3 position;
  double depth = 0.0;
  std::size_t place = 0;
};
[[nodiscard]] Fort14Node read_fort14_node(Tokenizer& tokens);

/// Reads an element's line up to the numbers of its corners, which follow; returns their count. end_numbers_of("an element") must be called
/// behind them.
[[nodiscard]] std::size_t read_fort14_element(Tokenizer& tokens);

/// Whether a land boundary of this type (IBTYPE) has heights or coefficients beside its nodes.
[[nodiscard]] bool is_fort14_weir(int type);

/// Reads the rest of the file: a group for each string, and one for the far side of a weir. `number`: reads a node's number and returns the
/// vertex. `source`: gets notes on the remaining data; may be null. Throws InputError.
[[nodiscard]] std::vector<Group> read_fort14_boundaries(Tokenizer& tokens, const std::function<Index(Tokenizer&, std::string_view)>& number,
                                                        SourceFile* source);

}  // namespace dmoscope
