#pragma once
// Interfaces that the parts of Nastran's bulk data format (.bdf, .nas, .dat) share.
// MSC Nastran Quick Reference Guide: Format of Bulk Data Entries; GRID, CTETRA, CPYRAM, CPENTA, CHEXA, CTRIA3, CQUAD4.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/format.h"
#include "core/io/reading/data_lines.h"

namespace dmoscope {

inline constexpr std::size_t kNastranNumber = 16;  // characters of a number in a large field
inline constexpr std::string_view kNastranProperty = "property";

/// Writer, see FormatHandler: nodes in large fields, elements in small ones. Throws OutputError, Cancelled.
Notes write_nastran(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);
/// Patcher, see FormatHandler: a node that moved gets large fields in any case.
Notes patch_nastran(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context);

// Cards of Nastran's bulk data: a name and fields, over one or more lines, in fixed columns or between commas.

class NastranCards {
 public:
  NastranCards(const SourceFile& source, Progress& progress) : lines_(source, progress) {}

  /// Continues with the card at byte `offset`, on this line (0: errors have no line).
  void seek(std::size_t offset, std::size_t line);
  /// Reads the next card; false at the end of the file or at ENDDATA. Comments ($) and empty lines are skipped. Throws InputError,
  /// Cancelled.
  [[nodiscard]] bool next();

  /// Name of the card in capitals, without the star of large fields: "GRID".
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// The n-th field behind the name, from 0, without blanks around; empty if there is none.
  [[nodiscard]] std::string_view field(std::size_t n) const noexcept { return n < fields_.size() ? fields_[n] : std::string_view(); }
  [[nodiscard]] std::size_t field_count() const noexcept { return fields_.size(); }
  /// Range of the card's bytes in the file, with the end of its last line.
  [[nodiscard]] std::size_t begin() const noexcept { return begin_; }
  [[nodiscard]] std::size_t end() const noexcept { return end_; }
  /// Whether comments or empty lines are between its lines.
  [[nodiscard]] bool interrupted() const noexcept { return interrupted_; }

  /// The n-th field as a number. Nastran's 1.5-3 is 0.0015; an empty field is 0. Throws InputError at the card's first line.
  [[nodiscard]] double real(std::size_t n, std::string_view what) const;
  [[nodiscard]] std::int32_t label(std::size_t n, std::string_view what) const;
  /// The n-th field as a whole number from 0 on; an empty field is 0.
  [[nodiscard]] int number_or_zero(std::size_t n, std::string_view what) const;
  [[noreturn]] void fail(const std::string& what) const;

  /// Function that next() calls with every comment line.
  std::function<void(std::string_view line)> on_comment;

 private:
  bool next_line();
  void take_line(std::string_view line);

  DataLines lines_;
  bool held_ = false;  // whether the last line read belongs to the next card
  bool passed_over_ = false;
  std::string_view line_;
  std::size_t line_begin_ = 0;
  std::deque<std::string> expanded_;  // lines with their tabs expanded
  std::string name_;
  std::vector<std::string_view> fields_;
  std::size_t begin_ = 0, end_ = 0, number_ = 0;
  bool interrupted_ = false;
};

}  // namespace dmoscope
