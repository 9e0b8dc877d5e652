#pragma once
// Vertices that the user names, in a mesh that ranks share.

#include <string>
#include <vector>

#include "core/mesh/vertex_words.h"
#include "mpi/mesh/share.h"

namespace dmoscope {

/// Forms of such words, in one line for --help: those of vertex_words.h but for groups other than strings.
inline constexpr std::string_view kSharedVertexWords =
    "ids from 0 and ranges (3,7-9 or vertices:3,7-9), a boundary string of a fort.14 (group:NAME), those with some number in the file's "
    "data "
    "(mat_id=3,5, of elements or points), or those in a box (box:X0,Y0,X1,Y1 or box:X0,Y0,Z0,X1,Y1,Z1)";

/// Words that were parsed, but not yet looked up.
class SharedVertexWords {
 public:
  /// Parses the words. Throws UsageError, which begins with the word.
  explicit SharedVertexWords(const std::vector<std::string>& words);
  /// The fields that the words need.
  [[nodiscard]] FieldFilter fields() const;
  /// Finds the vertices and elements that the words name; all ranks together. Throws UsageError (as SharedError on all) for a word that
  /// names nothing.
  [[nodiscard]] BlockMarks find(const World& world, const MeshBlock& block) const;

 private:
  /// One word; one of the members is set.
  struct Word {
    std::string text;
    std::vector<NumberRange> ranges{};
    std::string group{}, field{};
    std::vector<double> values{};  // values of the field
    NamedBox box{};
  };
  static Word read(const std::string& text);
  static void read_data(Word& word, std::string_view text);
  [[nodiscard]] static bool mark(const World& world, const MeshBlock& block, const Word& word, BlockMarks& marks);
  static bool mark_field(const MeshBlock& block, const Word& word, BlockMarks& marks);

  std::vector<Word> words_;
};

}  // namespace dmoscope
