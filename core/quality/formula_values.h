#pragma once
// A program evaluated for whole elements, up to kFormulaBatch at once.

#include <array>

#include "core/base/vec.h"
#include "core/formula/evaluator.h"

namespace dmoscope {

/// Takes elements in, one a slot, then evaluates all. Use within one thread; the room is the thread's and one is used at a time.
class FormulaValues {
 public:
  explicit FormulaValues(const FormulaProgram& program);
  /// given(input): the element's number.
  template <class Given>
  void set(std::size_t slot, const Given& given) {
    if (slot == 0) prepare(program_, given, uniforms_);
    for (const FormulaProgram::Given& one : program_.varying) registers_[one.at * kFormulaBatch + slot] = given(one.input);
    count_ = slot + 1;
  }
  void run();
  /// The value of a slot, after run(), as the formula computed it.
  [[nodiscard]] double quality(std::size_t slot) const { return FormulaResult<double>(program_, uniforms_, registers_)[slot]; }

 private:
  const FormulaProgram& program_;
  double* uniforms_;
  double* registers_;
  std::size_t count_ = 0;
};

}  // namespace dmoscope
