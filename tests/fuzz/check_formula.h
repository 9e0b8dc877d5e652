#pragma once
// Properties of any formula or target: it is refused with an Error that has a place in the text, or it means the same when it is read
// again, and has values for every element.

#include <cmath>
#include <stdexcept>
#include <string>

#include "core/base/error.h"
#include "core/quality/formula_facts.h"
#include "core/quality/formula_values.h"
#include "core/target/target.h"

namespace dmoscope::testing {

inline void check_values(const Formula& formula, ElementKind kind) {
  const FormulaProgram& program = formula.program(kind, FormulaSpace::Plain, FormulaUse::Elements, kNoIndex);
  for (const double size : {0.0, 1e-160, 1.0, 1e160}) {
    FormulaValues values(program);
    int n = 0;
    values.set(0, [&](const FormulaInput&) { return size * std::sin(static_cast<double>(++n)); });
    values.run();
    (void)values.quality(0);
  }
  for (Index corner = 0; corner < info(kind).corners; ++corner)
    if (formula.program(kind, FormulaSpace::Plain, FormulaUse::Places, corner).registers > kMostNumbers)
      throw std::logic_error("too many registers");
}

inline void check_formula(const std::string& text) {
  try {
    const Formula formula(text), again(formula.text());
    if (again.text() != formula.text()) throw std::logic_error("its text is read as another: " + formula.text());
    const FormulaFacts facts = facts_of(formula);
    const FormulaFacts same = facts_of(again);
    if (!(facts.summary == same.summary)) throw std::logic_error("its text means something else: " + formula.text());
    for (const FormulaFacts::OfKind& one : facts.kinds) check_values(formula, one.kind);
    (void)formula.kinds(FormulaSpace::Target);
    (void)formula.kinds(FormulaSpace::Stretched);
  } catch (const FormulaError& error) {
    std::size_t lines = 1;
    for (const char c : text) lines += c == '\n' ? 1U : 0U;
    if (error.place().line < 1 || error.place().line > lines || error.place().column < 1 || error.place().column > text.size() + 1)
      throw std::logic_error(std::string("an error is nowhere in the text: ") + error.what());
  } catch (const Error&) {
  }
  try {
    const Target target = parse_target(text);
    if (!(parse_target(to_text(target)) == target)) throw std::logic_error("a target is read as another");
  } catch (const Error&) {
  }
}

}  // namespace dmoscope::testing
