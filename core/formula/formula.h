#pragma once
// A metric defined by a formula: parsed, checked, and ready to be evaluated.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/formula/element_numbers.h"
#include "core/formula/program.h"
#include "core/formula/syntax.h"

namespace dmoscope {

// --- Translation of a formula's tree into programs ---

/// Thrown if a formula's body makes no sense for a kind of element, or not in a space; what() tells why.
class NotForKind : public FormulaError {
 public:
  using FormulaError::FormulaError;
};

struct LoweredFormula {
  FormulaProgram program;
  bool scale_free = true;
  std::string scale_note{};  // reason why it is not scale-free: "adds a length to a number (column 7)"; empty if it has a unit as a whole
  double power = 0.0;        // power of a length that it has as a whole
  bool uses_place = false;   // whether it changes when the mesh is moved
};

/// One of the smooth numbers whose least is the formula.
struct FormulaPiece {
  FormulaProgram program;    // program of FormulaUse::Elements
  std::uint8_t corners = 0;  // bits of the element's corners that it depends on
};

/// Translates a formula's body. `fields`: names of the fields used, in the order of FormulaInput::index; new ones are added. `use`,
/// `moving`: see FormulaProgram; if a formula is the least over the corners of a volume element, only corners count that the moving one
/// changes. Throws NotForKind, and FormulaError if the formula makes no sense for any kind.
[[nodiscard]] LoweredFormula lower(const FormulaSyntax& syntax, const FormulaBody& body, ElementKind kind, FormulaSpace space,
                                   FormulaUse use, Index moving, std::vector<std::string>& fields);
/// Translates a formula into pieces whose least it is in every element that is not inverted: see ProgramBuilder::pieces_of(). Throws as
/// lower() does.
[[nodiscard]] std::vector<FormulaPiece> lower_pieces(const FormulaSyntax& syntax, const FormulaBody& body, ElementKind kind,
                                                     FormulaSpace space, std::vector<std::string>& fields);

/// A parsed formula and its programs, for all kinds of elements that it fits. Immutable; programs are made on first use, by any thread.
class Formula {
 public:
  /// Parses and checks a formula. Throws FormulaError.
  explicit Formula(std::string_view text);
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;
  ~Formula();

  /// The formula in one line, without comments; its meaning is unchanged.
  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  [[nodiscard]] const std::string& title() const noexcept { return syntax_.title; }  // may be empty
  /// Kinds of elements that the formula fits in a space.
  [[nodiscard]] KindSet kinds(FormulaSpace space = FormulaSpace::Plain) const;
  /// Reason why it does not fit a kind; empty if it does.
  [[nodiscard]] std::string why_not(ElementKind kind, FormulaSpace space) const;
  /// Names of the fields that it reads, in the order of FormulaInput::index.
  [[nodiscard]] const std::vector<std::string>& fields() const noexcept { return fields_; }
  /// Whether its value stays when the mesh is scaled, for elements of a kind, or of all kinds that it fits.
  [[nodiscard]] bool scale_free(ElementKind kind) const noexcept { return !contains(with_unit_, kind); }
  [[nodiscard]] bool scale_free() const noexcept { return with_unit_ == 0; }
  [[nodiscard]] const std::string& scale_note() const noexcept { return scale_note_; }  // reason why it is not scale-free
  /// Whether it reads fields, whose unit is unknown.
  [[nodiscard]] bool uses_fields() const noexcept { return !fields_.empty(); }
  /// Whether its value changes when the mesh is moved.
  [[nodiscard]] bool uses_place() const noexcept { return uses_place_; }

  /// The smooth pieces whose least is the formula, for a kind of kinds(space). See lower_pieces().
  [[nodiscard]] std::span<const FormulaPiece> pieces(ElementKind kind, FormulaSpace space) const;
  /// The program for a kind of kinds(space). See FormulaProgram.
  [[nodiscard]] const FormulaProgram& program(ElementKind kind, FormulaSpace space, FormulaUse use, Index moving) const;

 private:
  struct Slot;
  struct Pieces;
  [[nodiscard]] Slot& slot(ElementKind kind, FormulaSpace space, FormulaUse use, Index moving) const;
  [[nodiscard]] const Slot& lowered(ElementKind kind, FormulaSpace space, FormulaUse use, Index moving) const;
  [[nodiscard]] const FormulaBody* body_of(ElementKind kind) const;
  void examine();

  FormulaSyntax syntax_;
  std::string text_;
  std::vector<std::string> fields_;
  KindSet with_unit_ = 0;  // kinds for which its value changes with the unit of length
  bool uses_place_ = false;
  std::string scale_note_;
  std::unique_ptr<Slot[]> slots_;
  std::unique_ptr<Pieces[]> pieces_;  // pieces by space and kind
};

}  // namespace dmoscope
