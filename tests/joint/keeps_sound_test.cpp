// Runs on meshes whose fixed vertices make it impossible to untangle all: where anything stays inverted, it was inverted before.

#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/joint/tangles.h"
#include "tests/smooth/promises.h"

namespace dmoscope {
namespace {

using namespace testing;

std::vector<Index> inverted_in(const InputMesh& mesh, std::span<const Vec3> positions) {
  std::vector<Index> inverted;
  for (Index e = 0; e < mesh.mesh.elements.size(); ++e)
    if (smallest_jacobian(mesh.quality_context(), positions, e) <= 0.0) inverted.push_back(e);
  return inverted;
}

/// Sound mesh, its free vertices tangled, with some of its boundary's vertices a little more than a cell inside.
Mesh held_tangle(Sound sound, Index cells, bool bent, Tangling tangling, unsigned seed) {
  Mesh mesh = sound_mesh(sound, cells, bent, seed);
  const dmoscope::Run fixes = make_run(input(mesh), {});
  const double cell = (bent ? 1.6 : 1.0) / static_cast<double>(cells);
  Mesh result = tangled(mesh, fixes.fixed(), tangling, cell, is_volume(sound), seed);
  Vec3 middle{};
  for (const Vec3& p : mesh.positions) middle = middle + (1.0 / static_cast<double>(mesh.positions.size())) * p;
  Random random(seed + 100);
  for (Index v = 0; v < mesh.positions.size(); ++v) {
    if (fixes.fixed()[v] == 0 || random(0.0, 1.0) > 0.06) continue;
    const Vec3 inwards = middle - mesh.positions[v];
    result.positions[v] = mesh.positions[v] + (random(0.8, 1.6) * cell / length(inwards)) * inwards;
  }
  return result;
}

struct Tried {
  int left = 0, before = 0, after = 0;  // meshes that keep inverted elements, and the numbers of these in them
};

void attempt(const std::shared_ptr<const InputMesh>& mesh, const char* method, const std::string& what, Tried& tried) {
  dmoscope::Run run = make_run(mesh, {.method = method});
  const std::vector<Index> before = inverted_in(*mesh, run.positions());
  Progress progress;
  run.iterate(60, progress);
  const std::vector<Index> after = inverted_in(*mesh, run.positions());
  if (after.empty()) return;
  ++tried.left;
  tried.before += static_cast<int>(before.size());
  tried.after += static_cast<int>(after.size());
  std::vector<Index> made;
  std::ranges::set_difference(after, before, std::back_inserter(made));
  EXPECT_TRUE(made.empty()) << what << ", " << method << ": " << made.size() << " of " << after.size() << ", before " << before.size();
}

TEST(KeepsSound, WhereTanglesStay) {
  Tried tried;
  for (const Sound sound : {Sound::Triangles, Sound::MixedPlane, Sound::Tetrahedra, Sound::Hexahedra, Sound::Wedges})
    for (const Tangling tangling : {Tangling::Swapped, Tangling::Folded, Tangling::Turned, Tangling::Strewn})
      for (const char* method : {"dmo", "active-set"}) {
        const auto mesh = input(held_tangle(sound, is_volume(sound) ? 4 : 10, true, tangling, 3));
        attempt(mesh, method, name_of(sound) + std::string(", ") + name_of(tangling), tried);
      }
  EXPECT_GE(tried.left, 20) << "else this test shows less than it says";
  EXPECT_LT(4 * tried.after, tried.before);
}

}  // namespace
}  // namespace dmoscope
