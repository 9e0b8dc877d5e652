// Meshes that were sound and were tangled in every way are sound again, whatever their elements; but for at most one in fifty.
// DMOSCOPE_ALL_TANGLES=1 tries some hundred larger ones.

#include "tests/joint/tangles.h"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/joint/joint_clusters.h"
#include "tests/smooth/promises.h"

namespace dmoscope {
namespace {

using namespace testing;

struct Tried {
  int tangled = 0, sound = 0;
  std::string left{};  // names of the meshes with elements left inverted
};

/// Tangles a sound mesh; where that inverts elements, untangles it by one call.
void attempt(Sound sound, Index cells, bool bent, Tangling tangling, unsigned seed, Tried& tried) {
  const Mesh mesh = sound_mesh(sound, cells, bent, seed);
  const auto before = input(mesh);
  const dmoscope::Run fixes = make_run(before, {});
  ASSERT_EQ(fixes.statistics().inverted, 0U);
  const double cell = (bent ? 1.6 : 1.0) / static_cast<double>(cells);
  const auto spoiled = input(tangled(mesh, fixes.fixed(), tangling, cell, is_volume(sound), seed));
  std::vector<Vec3> positions = spoiled->mesh.positions;
  const auto judge = [&] { return compute_statistics(spoiled->quality_context(), positions, Metric::MeanRatio, fixes.fixed(), nullptr); };
  const Statistics tangle = judge();
  if (tangle.inverted == 0) return;
  ++tried.tangled;
  Progress progress;
  ThreadPool pool(2);
  JointOptions options;
  options.pool = &pool;
  const auto found = untangle(*spoiled, Metric::MeanRatio, fixes.fixed(), {}, positions, options, progress);
  const Statistics now = judge();
  EXPECT_LE(now.inverted, tangle.inverted);
  EXPECT_GE(now.minimum, tangle.minimum);
  for (Index v = 0; v < positions.size(); ++v) {
    if (fixes.fixed()[v] == 0) continue;
    EXPECT_EQ(positions[v], mesh.positions[v]);
  }
  if (now.inverted == 0)
    ++tried.sound;
  else
    tried.left += std::string("\n  ") + (bent ? "bent " : "") + name_of(sound) + ", " + std::to_string(cells) + " cells, " +
                  name_of(tangling) + ", seed " + std::to_string(seed) + ": " + std::to_string(now.inverted) + " of " +
                  std::to_string(tangle.inverted);
}

TEST(Tangles, NearlyAllAreSoundAgain) {
  const bool all = std::getenv("DMOSCOPE_ALL_TANGLES") != nullptr;
  Tried tried;
  for (const Sound sound : kSounds)
    for (const Tangling tangling : kTanglings)
      for (const bool bent : {false, true})
        for (unsigned seed = 1; seed <= (all ? 4U : 2U); ++seed) {
          const Index small = is_volume(sound) ? 5 : 10, large = is_volume(sound) ? 10 : 40;
          attempt(sound, all && seed > 2 ? large : small, bent, tangling, seed, tried);
        }
  RecordProperty("tangled", tried.tangled);
  RecordProperty("sound", tried.sound);
  EXPECT_GE(tried.tangled, all ? 400 : 200);
  EXPECT_GE(50 * tried.sound, 49 * tried.tangled) << tried.sound << " of " << tried.tangled << tried.left;
}

TEST(Tangles, AreUndoneTheSameByAnyThreads) {
  for (const Sound sound : {Sound::MixedPlane, Sound::MixedVolume}) {
    const Mesh mesh = sound_mesh(sound, 6, true, 3);
    const auto before = input(mesh);
    const dmoscope::Run fixes = make_run(before, {});
    const auto spoiled = input(tangled(mesh, fixes.fixed(), Tangling::Scrambled, 0.3, is_volume(sound), 3));
    std::vector<Vec3> first;
    for (const unsigned threads : {1U, 2U, 8U}) {
      std::vector<Vec3> positions = spoiled->mesh.positions;
      Progress progress;
      ThreadPool pool(threads);
      JointOptions options;
      options.pool = &pool;
      ASSERT_TRUE(untangle(*spoiled, Metric::MeanRatio, fixes.fixed(), {}, positions, options, progress));
      if (first.empty()) first = positions;
      EXPECT_TRUE(same_bits(std::span(positions), std::span(first))) << name_of(sound) << ", " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace dmoscope
