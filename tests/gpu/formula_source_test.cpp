// Formulas as CUDA source, and the compiler for them.

#include "gpu/defined/formula_source.h"

#include <gmock/gmock.h>

#include "gpu/host_queue.h"
#include "gpu/nvrtc.h"
#include "tests/gpu/defined.h"

namespace dmoscope::gpu {
namespace {

using namespace testing;
using ::testing::HasSubstr;

std::optional<std::string> source_of(const InputMesh& mesh, const std::string& words) {
  const auto judge = mesh.quality_context().judge(parse_metric(words));
  return formula_source(ProgramTable(mesh, *judge), {.is_volume = mesh.is_volume()});
}

/// A formula of so many parts of a hundred terms, all of which differ.
std::string long_formula(int parts) {
  std::string text = "formula:", sum = "smin/smax";
  for (int part = 0; part < parts; ++part) {
    const std::string name = "a" + std::to_string(part);
    text += name + "=l12";
    for (int i = 1; i <= 100; ++i) text += "+sin(" + std::to_string(100 * part + i) + "*l12)";
    text += "; ";
    sum += "+" + name;
  }
  return text + sum;
}

/// Programs too long to be compiled are run step by step, with the processor's bits.
TEST(FormulaSource, IsNoneForLongPrograms) {
  const auto mesh = volume_input_of(dmoscope::testing::lattice(4, 0.3, 231));
  EXPECT_TRUE(source_of(*mesh, long_formula(1)).has_value());
  EXPECT_FALSE(source_of(*mesh, long_formula(13)).has_value());
  expect_same_visits(make_host_queue({}), Subject(mesh), parse_metric(long_formula(13)), {}, 1);
}

/// Constants are exact doubles, to the last bit.
TEST(FormulaSource, SaysConstantsExactly) {
  const auto mesh = volume_input_of(dmoscope::testing::lattice(4, 0.3, 231));
  EXPECT_THAT(*source_of(*mesh, "formula:smin/smax*0.1"), HasSubstr("Real(0x1.999999999999ap-4)"));
}

class NvrtcTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (Nvrtc::find() == nullptr) GTEST_SKIP() << "needs NVRTC, which is part of CUDA's toolkit";
  }
};

TEST_F(NvrtcTest, SaysWhatIsWrongWithASource) {
  try {
    (void)Nvrtc::find()->compile("__global__ void kernel() { nonsense; }", {}, 75);
    FAIL() << "it is no program";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(), HasSubstr("NVRTC"));
    EXPECT_THAT(error.what(), HasSubstr("nonsense"));
  }
}

/// A GPU that is newer than the compiler runs code for the newest that the compiler knows.
TEST_F(NvrtcTest, CompilesForGpusThatItDoesNotKnow) {
  const std::string ptx = Nvrtc::find()->compile("extern \"C\" __global__ void kernel() {}", {}, 999);
  EXPECT_THAT(ptx, HasSubstr(".entry kernel"));
  EXPECT_THAT(ptx, ::testing::Not(HasSubstr("sm_999")));
}

TEST_F(NvrtcTest, CompilesEveryFormOfSearch) {
  const auto plane = volume_input_of(with_fields(dmoscope::testing::lattice(4, 0.3, 231)));
  Progress progress;
  const auto solid = volume_input_of(with_fields(generate_mesh("solids", 64, 5, progress)));
  for (const auto& mesh : {plane, solid})
    for (const bool in_double : {false, true}) {
      const auto judge = mesh->quality_context().judge(parse_metric("formula:if(det > 0, atan2(smin, smax), -exp(det))"));
      const auto source = formula_source(ProgramTable(*mesh, *judge), {mesh->is_volume(), in_double});
      EXPECT_THAT(Nvrtc::find()->compile(*source, formula_headers(), 90), HasSubstr(kFormulaKernel));
    }
}

}  // namespace
}  // namespace dmoscope::gpu
