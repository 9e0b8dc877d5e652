// Hints of smooth after the mesh is written: they change neither the mesh nor the exit code.

#include <array>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Words = std::vector<std::string>;

/// A block of three by three squares, of which the inner one is wound the other way round.
std::string turned_square(const Folder& folder) {
  std::string text = "# vtk DataFile Version 2.0\nturned\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 16 double\n";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const bool inside = i % 3 != 0 && j % 3 != 0;
      text += fmt::format("{} {} 0\n", inside ? 3 - i : i, inside ? 3 - j : j);
    }
  text += "CELLS 9 45\n";
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const int a = 4 * j + i;
      text += fmt::format("4 {} {} {} {}\n", a, a + 1, a + 5, a + 4);
    }
  text += "CELL_TYPES 9\n9\n9\n9\n9\n9\n9\n9\n9\n9\n";
  return folder.file("turned.vtk", text);
}

TEST(Hints, ChangeNeitherTheMeshNorTheExitCodeOfAnyMix) {
  const Folder folder;
  Words meshes{turned_square(folder)};
  for (const std::string kind : {"random", "tetrahedra"}) {
    meshes.push_back(folder / (kind + ".vtk"));
    ASSERT_EQ(run({"generate", kind, "-o", meshes.back(), "--size", "40"}).code, 0);
  }
  std::mt19937 random(44);
  const auto one_of = [&random](const std::vector<Words>& choices) { return choices[random() % choices.size()]; };
  int ran = 0;
  for (int i = 0; i < 36; ++i) {
    const Words mesh{meshes[static_cast<std::size_t>(i) % meshes.size()]};
    const Words mix[]{one_of({{"dmo"}, {"laplace"}, {"smart-laplace"}, {"angle-based"}, {"dvr"}, {"pattern-search"}, {"joint"}}),
                      one_of({{}, {}, {"--metric", "formula:det/norm^2"}, {"--target", "input"}, {"--combine", "mean-ratio:0.3:density"}}),
                      one_of({{}, {"--boundary", "slide"}}), one_of({{}, {}, {"--then", "mean"}, {"--then", "joint"}})};
    const auto call = [&](const std::string& hints) {
      Words words{"smooth",    mesh[0], "-o",      folder / (hints + ".vtk"), "--hints", hints, "--json", "--iterations", "1",
                  "--threads", "1",     "--method"};
      for (const Words& more : mix) words.insert(words.end(), more.begin(), more.end());
      return run(words);
    };
    const Output without = call("off"), with = call("full");
    const std::string what = fmt::format("{}: {}", i, with.err);
    EXPECT_EQ(without.code, with.code) << what;
    if (without.code > 1) continue;
    ++ran;
    EXPECT_TRUE(json_of(without)["held_by"].is_null()) << what;
    EXPECT_THAT(without.err, Not(HasSubstr("try --method"))) << what;
    const auto told = json_of(with);
    EXPECT_TRUE(told["held_by"].is_object() || told["after"]["minimum"] > 1.0 - 1e-9) << what;  // nothing holds what is ideal
    EXPECT_EQ(read_file(folder / "off.vtk"), read_file(folder / "full.vtk")) << what;
  }
  EXPECT_GT(ran, 12);
}

/// A run with the option that a hint names reaches the result that the hint tells.
TEST(Hints, WhatWasTriedIsReachedByTheOption) {
  const Folder folder;
  int kept = 0;
  for (const std::string kind : {"coast", "annulus", "quads", "mixed", "random", "tetrahedra", "screw", "biased"}) {
    SCOPED_TRACE(kind);
    const std::string in = folder / (kind + ".vtk"), out = folder / (kind + "-out.vtk"), next = folder / (kind + "-next.vtk");
    ASSERT_EQ(run({"generate", kind, "-o", in, "--size", "400"}).code, 0);
    const auto first = json_of(run({"smooth", in, "-o", out, "--until-converged", "--hints", "full", "--json"}));
    const auto& held = first["held_by"];
    const std::string sentence = held["sentence"].get<std::string>();
    EXPECT_THAT(sentence, Not(HasSubstr("about"))) << "no number but one that was tried";
    if (held["switch"].is_null()) continue;
    if (held["tried"].is_null()) {
      EXPECT_THAT(sentence, HasSubstr("on the whole mesh that was not tried"));
      continue;
    }
    EXPECT_EQ(held["tried"]["from"], first["after"]["minimum"]);
    EXPECT_LE(held["tried"]["iterations"], 1000);
    Words words{"smooth", out, "-o", next, "--until-converged", "--json"};
    for (const std::string& word : split(held["switch"].get<std::string>(), ' ')) words.push_back(word);
    const auto second = json_of(run(words));
    EXPECT_GE(second["after"]["minimum"].get<double>(), held["tried"]["to"].get<double>()) << sentence;
    EXPECT_GE(second["after"]["minimum"], first["after"]["minimum"]) << sentence;
    if (held["tried"]["to"].get<double>() > held["tried"]["from"].get<double>() + 1e-4) {
      ++kept;
      EXPECT_THAT(sentence, HasSubstr("tried: "));
    }
  }
  EXPECT_GT(kept, 2);
}

TEST(Hints, ATangledMeshThatSlidesIsUntangledAndHasItsSummary) {
  const Folder folder;
  const Output said = run(
      {"smooth", turned_square(folder), "-o", folder / "out.vtk", "--method", "smart-laplace", "--boundary", "slide", "--iterations", "2"});
  EXPECT_EQ(said.code, 0) << said.err;
  EXPECT_THAT(said.out, HasSubstr("which untangled 4 of 4 inverted elements"));
  EXPECT_THAT(said.out, HasSubstr("wrote "));
}

TEST(Hints, AComparisonOfAllMethodsLeavesOutThoseThatCannotBe) {
  const Folder folder;
  ASSERT_EQ(run({"generate", "tetrahedra", "-o", folder / "cube.vtk", "--size", "60"}).code, 0);
  const Output said = run({"compare", folder / "cube.vtk", "--every", "method", "--boundary", "slide", "--iterations", "1"});
  EXPECT_LE(said.code, 1) << said.err;
  EXPECT_THAT(said.out, HasSubstr("angle-based is defined only for planar meshes and surfaces"));
}

TEST(Hints, AWordThatIsNoneIsRefusedBeforeAnythingIsDone) {
  const Folder folder;
  const Output refused = run({"smooth", turned_square(folder), "-o", folder / "out.vtk", "--hints", "of"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("known are on, full, off"));
  EXPECT_FALSE(exists(folder / "out.vtk"));
}

}  // namespace
}  // namespace dmoscope::test
