#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/io/medit/medit.h"
#include "core/io/reading/source_file.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {

namespace {

constexpr TextSyntax kSolSyntax{.comment = '#', .comma_is_blank = false, .backslash_joins_lines = false, .free_form = true};

class SolReader {
 public:
  SolReader(std::string_view text, const std::filesystem::path& file, Mesh& mesh, Progress& progress)
      : tokens_(text, file.string(), kSolSyntax, progress), mesh_(mesh), progress_(progress) {}

  /// Reads the file; returns the keywords that were skipped.
  std::vector<std::string> read() {
    if (const std::string_view first = tokens_.token(); !equal_ignoring_case(first, "MeshVersionFormatted"))
      tokens_.fail(fmt::format("a solution file begins with MeshVersionFormatted, this one with {}", quote_token(first)));
    (void)tokens_.read_integer("version after MeshVersionFormatted");
    while (!tokens_.at_end()) {
      const std::string_view keyword = tokens_.token();
      if (equal_ignoring_case(keyword, "End")) break;
      if (equal_ignoring_case(keyword, "Dimension"))
        dimension();
      else if (equal_ignoring_case(keyword, "SolAtVertices"))
        solutions();
      else
        pass_over(keyword);
    }
    return std::move(passed_over_);
  }

 private:
  [[nodiscard]] static bool is_word(std::string_view token) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    return !token.empty() && is_letter(token[0]) && !equal_ignoring_case(token, "nan") && !equal_ignoring_case(token, "inf") &&
           !equal_ignoring_case(token, "infinity");
  }
  /// Skips a keyword that does not concern vertices, such as Time or SolAtTriangles, and its numbers.
  void pass_over(std::string_view keyword) {
    if (!is_word(keyword)) tokens_.fail(fmt::format("expected a keyword such as SolAtVertices or End, got {}", quote_token(keyword)));
    if (std::ranges::find(passed_over_, keyword) == passed_over_.end()) passed_over_.emplace_back(keyword);
    for (std::size_t n = 0; !tokens_.at_end(); ++n) {
      if (n % 65536 == 0) progress_.check();
      const std::size_t offset = tokens_.offset(), line = tokens_.line();
      if (!is_word(tokens_.token())) continue;
      tokens_.seek(offset, line);
      return;
    }
  }

  void dimension() {
    dimension_ = tokens_.read_integer("dimension");
    if (dimension_ != 2 && dimension_ != 3) tokens_.fail(fmt::format("Dimension {}: only 2 and 3 dimensions are read", dimension_));
  }

  void solutions() {
    if (dimension_ == 0) tokens_.fail("SolAtVertices before Dimension");
    const std::size_t count = tokens_.read_count("number of SolAtVertices", 2);
    if (count != mesh_.positions.size())
      tokens_.fail(fmt::format("solutions at {} vertices, but the mesh has {}", count, mesh_.positions.size()));
    const std::int64_t kinds = tokens_.read_integer("number of solutions");
    if (kinds < 1 || kinds > 100) tokens_.fail(fmt::format("{} solutions at a vertex: 1 to 100 are read", kinds));
    std::vector<Field> fields;
    for (std::int64_t i = 0; i < kinds; ++i) fields.push_back(begin(tokens_.read_integer("type of a solution"), count));
    std::uint32_t words = 0;
    for (const Field& field : fields) words += static_cast<std::uint32_t>(field.components);
    (void)tokens_.at_end();
    for (Field& field : fields) field.place = {tokens_.offset(), words};
    for (std::size_t v = 0; v < count; ++v) {
      if (v % 65536 == 0) progress_.check();
      for (Field& field : fields)
        for (int c = 0; c < field.components; ++c) field.values.push_back(tokens_.read_double("value of a solution"));
    }
    for (Field& field : fields) mesh_.fields.push_back(std::move(field));
  }

  Field begin(std::int64_t type, std::size_t count) {
    if (type < 1 || type > 3)
      tokens_.fail(fmt::format("a solution of type {}: 1 (a number), 2 (a vector) and 3 (a symmetric tensor) are read", type));
    Field field;
    field.name = type == 1 ? "sol" : type == 2 ? "sol-vector" : "metric";
    field.role = "solution";
    field.components = static_cast<int>(type == 1 ? 1 : type == 2 ? dimension_ : dimension_ * (dimension_ + 1) / 2);
    const std::string name = field.name;
    for (int n = 2; is_taken(field.name); ++n) field.name = fmt::format("{}-{}", name, n);
    names_.push_back(field.name);
    field.values.reserve(count * static_cast<std::size_t>(field.components));
    return field;
  }
  [[nodiscard]] bool is_taken(const std::string& name) const {
    return std::ranges::find(names_, name) != names_.end() || std::ranges::find(mesh_.fields, name, &Field::name) != mesh_.fields.end();
  }

  Tokenizer tokens_;
  Mesh& mesh_;
  Progress& progress_;
  std::int64_t dimension_ = 0;
  std::vector<std::string> names_, passed_over_;
};

}  // namespace

std::vector<std::string> read_solutions(const std::filesystem::path& file, Mesh& mesh, Progress& progress) {
  const FileBytes bytes = read_whole_file(file, progress);
  return SolReader(bytes.view(), file, mesh, progress).read();
}

std::vector<std::filesystem::path> solutions_beside(const SourceFile& source, const IoContext& /*context*/) {
  std::filesystem::path file = source.path();
  if (equal_ignoring_case(file.extension().string(), ".gz")) file.replace_extension();
  file.replace_extension(".sol");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return {};
  return {std::move(file)};
}

void read_solutions_beside(SourceFile& source, Mesh& mesh, Progress& progress) {
  const std::vector<std::filesystem::path> found = solutions_beside(source, progress);
  if (found.empty()) return;
  const std::filesystem::path& file = found.front();
  const std::size_t fields = mesh.fields.size();
  try {
    constexpr std::size_t kMostNamed = 8;
    std::vector<std::string> left = read_solutions(file, mesh, progress);
    if (left.size() > kMostNamed) {
      left.resize(kMostNamed);
      left.emplace_back("...");
    }
    const std::string passed_over = left.empty() ? std::string() : fmt::format(", where this was passed over: {}", fmt::join(left, ", "));
    if (mesh.fields.size() == fields) {
      source.add_note(fmt::format("{} beside it has no solutions at vertices{}", file.filename().string(), passed_over));
      return;
    }
    source.add_note(fmt::format("fields read from {} beside it{}", file.filename().string(), passed_over));
    source.set_beside(file.filename().string(), fields);
  } catch (const InputError& error) {  // ignored: the mesh is valid without it
    mesh.fields.resize(fields);
    source.add_note(fmt::format("the fields beside it were not read: {}", error.what()));
  }
}

}  // namespace dmoscope
