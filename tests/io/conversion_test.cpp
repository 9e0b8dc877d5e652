// From every format to every other: positions and connectivity are kept exactly, and content that is lost is named.

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "core/io/writing/atomic_file.h"
#include "tests/fuzz/check_reader.h"
#include "tests/fuzz/samples.h"

namespace dmoscope::testing {
namespace {

/// Whether faces have the same vertices in the same order; formats that name them as sides of elements begin with another corner.
bool same_faces(const ElementTable& a, const ElementTable& b) {
  if (a.size() != b.size()) return false;
  for (Index f = 0; f < a.size(); ++f) {
    if (!std::ranges::is_permutation(a.corners(f), b.corners(f))) return false;
  }
  return true;
}

TEST(Conversion, EverySampleToEveryFormat) {
  int converted = 0;
  for (const Sample& sample : samples()) {
    const Mesh mesh = read_bytes(sample.format, sample.bytes);
    for (const FormatInfo& format : format_table()) {
      if (format.name == "pvtu") continue;  // several files, see pvtu_test.cpp
      SCOPED_TRACE(sample.format + " " + sample.name + " to " + std::string(format.name));
      Written written;
      try {
        written = write_anew(format.name, mesh, mesh.positions);
      } catch (const OutputError& error) {
        EXPECT_STRNE(error.what(), "");
        continue;
      }
      ++converted;
      const Mesh again = read_bytes(format.name, written.bytes);
      if (format.name == "medit" && !std::ranges::is_sorted(mesh.elements.kinds())) {
        // The format lists elements by kind, as the notes say.
        EXPECT_EQ(again.elements.size(), mesh.elements.size());
        EXPECT_EQ(again.positions, mesh.positions);
        EXPECT_FALSE(written.notes.empty());
        continue;
      }
      EXPECT_NO_THROW(
          check_same(mesh, narrowed(format.name, mesh.positions), again, format.name != "stl", again.source->layout().components == 3));
      for (const Field& field : mesh.fields) {
        bool named = false;
        for (const std::string& note : written.notes) named = named || note.find(field.name) != std::string::npos;
        bool kept = false;
        for (const Field& other : again.fields) {
          bool same = other.on == field.on && other.values.size() == field.values.size();
          for (std::size_t i = 0; same && i < other.values.size(); ++i) same = same_values(other.values[i], field.values[i]);
          kept = kept || same;
        }
        EXPECT_TRUE(named || kept) << "field " << field.name << " is lost without a word";
      }
      for (const Group& group : mesh.groups) {
        bool named = false;
        for (const std::string& note : written.notes) {
          const bool among_more = note.find(group.role) != std::string::npos && note.find(" more;") != std::string::npos;
          named = named || among_more || note.find(group.name) != std::string::npos;
        }
        bool kept = false;
        for (const Group& other : again.groups) kept = kept || (other.members == group.members && same_faces(other.faces, group.faces));
        EXPECT_TRUE(named || kept) << "group " << group.name << " is lost without a word";
      }
    }
  }
  EXPECT_GE(converted, 50);
}

TEST(Conversion, WhatOnlyTheFileHeldIsNamedAndARefusalLeavesTheOldFile) {
  const std::filesystem::path folder = scratch_path().string() + "-folder";
  std::filesystem::create_directories(folder);
  write_file_atomically(folder / "in.vtk", vtk_ascii());
  write_file_atomically(folder / "out.stl", "what stood there before");
  Progress progress;
  const Mesh mesh = read_mesh(folder / "in.vtk", progress);
  const std::vector<std::string> notes = write_mesh(folder / "out.off", mesh, mesh.positions, progress);
  EXPECT_THAT(notes, ::testing::Contains(::testing::HasSubstr("\"line cells\"")));
  EXPECT_THAT(notes, ::testing::Contains(::testing::HasSubstr("data of cells that are no elements of in.vtk")));
  EXPECT_THAT(notes, ::testing::Contains(::testing::HasSubstr("\"flow\"")));
  // A file of the same format keeps all content, without a note.
  EXPECT_TRUE(write_mesh(folder / "out.vtk", mesh, mesh.positions, progress).empty());
  EXPECT_EQ(read_whole_file(folder / "out.vtk", progress).view(), vtk_ascii());
  EXPECT_THROW(write_mesh(folder / "out.stl", mesh, mesh.positions, progress), OutputError);
  EXPECT_EQ(read_whole_file(folder / "out.stl", progress).view(), "what stood there before");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace dmoscope::testing
