#include "core/formula/formula.h"

#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "core/formula/syntax.h"

namespace dmoscope {

struct Formula::Slot {
  std::once_flag once;
  std::optional<LoweredFormula> formula;
  std::optional<FormulaError> why_not;
};

struct Formula::Pieces {
  std::once_flag once;
  std::vector<FormulaPiece> all;
};

namespace {

constexpr std::size_t kCorners = 9;  // corners that may move: up to 8, and none

/// Formula in one line: a blank wherever there may be one, except around brackets and commas.
std::string one_line(std::string_view text) {
  std::string line;
  const auto tokens = tokens_of(text);
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    const Token& token = tokens[i];
    const bool first = line.empty();
    switch (token.kind) {
      case TokenKind::Separator: {
        std::size_t next = i + 1;
        while (tokens[next].kind == TokenKind::Separator) ++next;
        const bool ends = tokens[next].kind == TokenKind::End || tokens[next].is("}");
        if (!first && !ends && !line.ends_with("; ") && !line.ends_with("{ ") && !line.ends_with("} ")) line += "; ";
        break;
      }
      case TokenKind::Text:
        line += fmt::format("\"{}\"", token.text);
        break;
      case TokenKind::Sign:
        if (token.is("{") || token.is("}"))
          line.append(first || line.ends_with(' ') ? "" : " ").append(token.text).append(1, ' ');
        else if (token.is(","))
          line += ", ";
        else
          line += token.text;
        break;
      default:
        line += token.text;
    }
  }
  while (line.ends_with(' ') || line.ends_with(';')) line.pop_back();
  return line;
}

}  // namespace

Formula::Formula(std::string_view text)
    : syntax_(parse_formula(text)),
      text_(one_line(text)),
      slots_(std::make_unique<Slot[]>(kFormulaSpaces * kElementKindCount * 2 * kCorners)),
      pieces_(std::make_unique<Pieces[]>(kFormulaSpaces * kElementKindCount)) {
  examine();
}

Formula::~Formula() = default;

const FormulaBody* Formula::body_of(ElementKind kind) const {
  for (const FormulaBody& body : syntax_.bodies)
    if (body.kinds == 0 || contains(body.kinds, kind)) return &body;
  return nullptr;
}

Formula::Slot& Formula::slot(ElementKind kind, FormulaSpace space, FormulaUse use, Index moving) const {
  const std::size_t corner = moving == kNoIndex ? kCorners - 1 : moving;
  return slots_[((static_cast<std::size_t>(space) * kElementKindCount + static_cast<std::size_t>(kind)) * 2 +
                 static_cast<std::size_t>(use)) *
                    kCorners +
                corner];
}

const Formula::Slot& Formula::lowered(ElementKind kind, FormulaSpace space, FormulaUse use, Index moving) const {
  Slot& slot = this->slot(kind, space, use, moving);
  std::call_once(slot.once, [&] {
    std::vector<std::string> fields = fields_;
    try {
      slot.formula = lower(syntax_, *body_of(kind), kind, space, use, moving, fields);
    } catch (const FormulaError& error) {
      slot.why_not = error;
    }
  });
  return slot;
}

/// Lowers the formula for every kind to find its errors. If it fits no kind, an error that concerns all kinds is preferred to one of a
/// single kind.
void Formula::examine() {
  std::optional<FormulaError> first;
  bool any = false, of_kind = false;
  for (std::size_t k = 0; k < kElementKindCount; ++k) {
    const auto kind = static_cast<ElementKind>(k);
    const FormulaBody* body = body_of(kind);
    if (body == nullptr) continue;
    try {
      const LoweredFormula lowered = lower(syntax_, *body, kind, FormulaSpace::Plain, FormulaUse::Elements, kNoIndex, fields_);
      any = true;
      if (!lowered.scale_free) with_unit_ = static_cast<KindSet>(with_unit_ | kind_set(kind));
      if (!lowered.scale_free && scale_note_.empty()) {
        scale_note_ = !lowered.scale_note.empty()
                          ? lowered.scale_note
                          : fmt::format("of a {} it is a length to the power of {:.4g}", info(kind).name, lowered.power);
      }
      uses_place_ = uses_place_ || lowered.uses_place;
    } catch (const FormulaError& error) {
      if (body->kinds != 0) throw;
      const bool only_kind = dynamic_cast<const NotForKind*>(&error) != nullptr;
      if (!first || (of_kind && !only_kind)) first = error, of_kind = only_kind;
    }
  }
  if (!any) throw *first;
}

KindSet Formula::kinds(FormulaSpace space) const {
  KindSet kinds = 0;
  for (std::size_t k = 0; k < kElementKindCount; ++k) {
    const auto kind = static_cast<ElementKind>(k);
    if (why_not(kind, space).empty()) kinds = static_cast<KindSet>(kinds | kind_set(kind));
  }
  return kinds;
}

std::string Formula::why_not(ElementKind kind, FormulaSpace space) const {
  if (body_of(kind) == nullptr) return fmt::format("it says nothing of {}", info(kind).plural);
  const Slot& slot = lowered(kind, space, FormulaUse::Elements, kNoIndex);
  return slot.why_not ? slot.why_not->what() : std::string();
}

std::span<const FormulaPiece> Formula::pieces(ElementKind kind, FormulaSpace space) const {
  Pieces& pieces = pieces_[static_cast<std::size_t>(space) * kElementKindCount + static_cast<std::size_t>(kind)];
  std::call_once(pieces.once, [&] {
    std::vector<std::string> fields = fields_;
    pieces.all = lower_pieces(syntax_, *body_of(kind), kind, space, fields);
  });
  return pieces.all;
}

const FormulaProgram& Formula::program(ElementKind kind, FormulaSpace space, FormulaUse use, Index moving) const {
  return lowered(kind, space, use, moving).formula.value().program;
}

}  // namespace dmoscope
