#pragma once
// A metric that a person wrote: read, understood, and ready to be evaluated.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/formula/lowering.h"

namespace dmoscope {

/// What a formula is for elements of the kinds that it makes sense for. Immutable; programs are made when they are first asked for, by any
/// thread.
class Formula {
 public:
  /// Throws FormulaError.
  explicit Formula(std::string_view text);
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;
  ~Formula();

  /// In one line, without comments; means the same.
  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  [[nodiscard]] const std::string& title() const noexcept { return syntax_.title; }  // may be empty
  /// For which it makes sense, in a space.
  [[nodiscard]] KindSet kinds(FormulaSpace space = FormulaSpace::Plain) const;
  /// Why not for a kind; empty where it does.
  [[nodiscard]] std::string why_not(ElementKind kind, FormulaSpace space) const;
  /// Names of the fields that it reads, in the order of FormulaInput::index.
  [[nodiscard]] const std::vector<std::string>& fields() const noexcept { return fields_; }
  /// Does it stay when the mesh is made larger or smaller? For elements of a kind, or of all that it is for.
  [[nodiscard]] bool scale_free(ElementKind kind) const noexcept { return !contains(with_unit_, kind); }
  [[nodiscard]] bool scale_free() const noexcept { return with_unit_ == 0; }
  [[nodiscard]] const std::string& scale_note() const noexcept { return scale_note_; }  // why not
  /// Does it read fields, whose unit nobody knows?
  [[nodiscard]] bool uses_fields() const noexcept { return !fields_.empty(); }
  /// Does it change when the mesh is moved?
  [[nodiscard]] bool uses_place() const noexcept { return uses_place_; }

  /// The smooth numbers that it is the least of, for a kind of kinds(space). See lower_pieces().
  [[nodiscard]] std::span<const FormulaPiece> pieces(ElementKind kind, FormulaSpace space) const;
  /// For a kind of kinds(space). See FormulaProgram.
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
  KindSet with_unit_ = 0;  // of the kinds it is for: for which it changes with the unit of length
  bool uses_place_ = false;
  std::string scale_note_;
  std::unique_ptr<Slot[]> slots_;
  std::unique_ptr<Pieces[]> pieces_;  // by space and kind
};

}  // namespace dmoscope
