// Robustness of the program against any files, and any end of the process.

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <thread>

#include <elf.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

constexpr const char* kTwoTriangles = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

bool has_controls(const std::string& text) {
  return std::ranges::any_of(text, [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7F; }) ||
         text.find("\xc2\x9b") != std::string::npos;
}

TEST(Terminal, NothingInFilesOrNamesReachesItRaw) {
  const Folder folder;
  const std::string escape =
      "\x1b]0;owned\x07\x1b[31m\xc2\x9b"
      "2J\x7f";
  const std::string named = folder.file("a" + escape + ".off", kTwoTriangles);
  const std::string vtu = "<VTKFile type=\"UnstructuredGrid\" compressor=\"" + escape.substr(1, 8) +
                          "\xc2\x9b\"><UnstructuredGrid><Piece NumberOfPoints=\"1\" " +
                          "NumberOfCells=\"1\"><Points><DataArray type=\"Float32\" Name=\"\xc2\x9b\x7f\" NumberOfComponents=\"3\" "
                          "format=\"binary\">AAAA</DataArray>"
                          "</Points></Piece></UnstructuredGrid></VTKFile>";
  const std::string su2 =
      "NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1 0\n0 1\nMARKER_TAG= m" + escape + "\nMARKER_ELEMS= 1\n3 0 1\n" + escape + "KEY= 1\n";
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"quality", named},
           {"quality", named, "--json"},
           {"quality", folder / ("none" + escape)},
           {"smooth", named, "-o", folder / ("out" + escape + ".off")},
           {"smooth", named, "-o", folder / "out.off", "--fix", escape},
           {"smooth", named, "-o", folder / "out.off", "--json", "--provenance"},
           {"convert", folder.file("m.su2", su2), folder / "m.off"},
           {"quality", folder.file("c.vtu", vtu)},
           {"quality", folder.file("k.msh", "$" + escape + "\n")},
           {"quality", folder.file("k.off", "OFF\n4 2 0\n0 0 " + escape + "\n")},
           {"script", folder.file("s.txt", "open \"" + named + "\"\nsay " + escape + "\nexpect " + escape + " < 1\n")},
           {"script",
            folder.file("open.json.txt", "open-state \"" + folder.file("s.json", "{\"format\": \"" + escape.substr(8) + "\"}") + "\"\n")},
           {"--" + escape}}) {
    const Output output = run(arguments);
    EXPECT_FALSE(has_controls(output.out)) << ::testing::PrintToString(arguments) << "\n" << ::testing::PrintToString(output.out);
    EXPECT_FALSE(has_controls(output.err)) << ::testing::PrintToString(arguments) << "\n" << ::testing::PrintToString(output.err);
  }
}

TEST(Terminal, EverythingIsPrintedInOnePlace) {
  for (const char* module : {"/app", "/core", "/gpu", "/render", "/ui"}) {
    for (const auto& entry : fs::recursive_directory_iterator(std::string(DMOSCOPE_SOURCE_DIR) + module)) {
      const std::string path = entry.path().string();
      if (!path.ends_with(".cpp") && !path.ends_with(".h")) continue;
      if (path.ends_with("app/common/console.cpp") || path.ends_with("app/common/console.h")) continue;
      const std::string source = read_file(path);
      for (const char* way : {"fmt::print(", "std::printf(", "std::fprintf(", "std::puts(", "std::fputs(", "std::cout", "std::cerr"})
        for (std::size_t at = source.find(way); at != std::string::npos; at = source.find(way, at + 1))
          EXPECT_THAT(source.substr(at, source.find('\n', at) - at), HasSubstr("terminal_line(")) << path << ": " << way;
    }
  }
}

TEST(Script, OverwritesNeitherItsMeshesNorItself) {
  const Folder folder;
  const std::string mesh = folder.file("mm.off", kTwoTriangles), script = folder / "s.txt";
  fs::create_symlink("mm.off", folder / "link.csv");
  for (const std::string& line : {"stats " + mesh, "elements " + mesh, "export " + mesh, "save-state " + mesh,
                                  "stats " + (folder / "link.csv"), "screenshot --window " + mesh, "stats " + script}) {
    const std::string text = "export \"" + (folder / "first.off") + "\"\nopen \"" + mesh + "\"\n" + line + "\n";
    const Output output = run({"script", folder.file("s.txt", text)});
    EXPECT_EQ(output.code, 2) << line << output.err;
    EXPECT_THAT(output.err, HasSubstr("s.txt:3: ")) << line;
    EXPECT_THAT(output.err, HasSubstr("would overwrite")) << line;
    EXPECT_EQ(read_file(mesh), kTwoTriangles);
    EXPECT_EQ(read_file(script), text);
    EXPECT_FALSE(exists(folder / "first.off")) << "refused before the first line ran";
  }
  const std::string good = "open \"" + mesh + "\"\nexport \"" + (folder / "new.off") + "\"\nopen \"" + (folder / "new.off") + "\"\n";
  EXPECT_EQ(run({"script", folder.file("s.txt", good)}).code, 0);
}

TEST(BadOutput, AFileThatGrowsTooLargeIsAnErrorLikeAFullDisk) {
  const Folder folder;
  Call call;
  call.arguments = {"convert", sample("coast.14"), folder / "out.vtk"};
  call.file_limit = 20000;
  const Output output = run(call);
  EXPECT_EQ(output.code, 3) << output.err;
  EXPECT_THAT(output.err, HasSubstr("out.vtk: File too large"));
  EXPECT_TRUE(names_in(folder / "").empty());
}

TEST(BadOutput, TheMeshStaysWhereTheStatisticsCannotBeWritten) {
  const Folder folder;
  const std::string mesh = folder.file("out.off", kTwoTriangles);
  Call call;  // the mesh fits, 3000 iterations' statistics do not
  call.arguments = {"smooth", folder.file("in.off", kTwoTriangles), "-o", mesh, "--stats", folder / "s.csv", "--iterations", "3000"};
  call.file_limit = 20000;
  const std::string before = "OFF\n# the old one\n" + std::string(kTwoTriangles).substr(4);
  std::ofstream(mesh, std::ios::binary) << before;
  const Output output = run(call);
  EXPECT_EQ(output.code, 3) << output.err;
  EXPECT_EQ(read_file(mesh), before);
  EXPECT_EQ(names_in(folder / ""), (std::vector<std::string>{"in.off", "out.off"}));
}

TEST(BadInput, PipesAndDevicesAreNoMeshes) {
  const Folder folder;
  const std::string pipe = folder / "pipe.off";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& input : {pipe, std::string("/dev/zero")}) {
    Call call;
    call.limit = std::chrono::seconds(60);
    call.arguments = {"quality", input};
    const Output output = run(call);
    EXPECT_EQ(output.code, 3) << input;
    EXPECT_THAT(output.err, HasSubstr(input + ": a ")) << input;
  }
  EXPECT_EQ(run({"script", "/dev/zero"}).code, 3);
}

TEST(Signals, ThatAskForTheEndLeaveNothingBehind) {
  for (const int signal : {SIGTERM, SIGHUP, SIGQUIT}) {
    const Folder folder;
    Call call;
    call.arguments = {"smooth", sample("coast.14"), "-o", folder / "out.14", "--iterations", "1000000000"};
    call.interrupt = std::chrono::milliseconds(700);
    call.signal = signal;
    const Output output = run(call);
    EXPECT_EQ(output.code, 1) << signal << output.err;
    EXPECT_THAT(output.err, HasSubstr("cancelled")) << signal;
    EXPECT_TRUE(names_in(folder / "").empty()) << signal;
  }
}

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DMOSCOPE_SHADOWED 1
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DMOSCOPE_SHADOWED 1
#endif

TEST(MaxMemory, NamesTheFileThatNeedsMore) {
#ifdef DMOSCOPE_SHADOWED
  GTEST_SKIP() << "a sanitizer takes more memory than can be limited";
#endif
  const Folder folder;
  const std::string mesh = folder.file("mesh.off", kTwoTriangles), large = folder.file("large.off", kTwoTriangles);
  fs::resize_file(large, std::uint64_t{3} << 30U);  // sparse: nothing is on the disk
  EXPECT_EQ(run({"quality", mesh, "--max-memory", "1G"}).code, 0);
  const Output output = run({"quality", large, "--max-memory", "16M"});
  EXPECT_EQ(output.code, 3);
  EXPECT_THAT(output.err, HasSubstr(large + ": not enough memory for this mesh"));
  EXPECT_EQ(run({"quality", mesh, "--max-memory", "16Q"}).code, 2);
}

/// Starts the program; the caller waits for it.
pid_t start(std::vector<std::string> arguments) {
  const pid_t child = fork();
  if (child != 0) return child;
  std::vector<char*> words{const_cast<char*>(DMOSCOPE_PROGRAM)};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  execv(DMOSCOPE_PROGRAM, words.data());
  _exit(127);
}

// DMOSCOPE_KILLS, such as 60, is the number of kills, for more certainty.
TEST(Kill, LeavesTheOldFileOrTheNewOneAndNoLitterAfterTheNextSave) {
  const char* const wanted = std::getenv("DMOSCOPE_KILLS");
  const int kills = wanted != nullptr ? std::atoi(wanted) : 20;
  const Folder folder;
  const std::string target = folder / "target.obj", source = folder / "source.off";
  ASSERT_EQ(run({"generate", "grid", "--size", "20000", "-o", source}).code, 0);
  const auto begun = std::chrono::steady_clock::now();
  ASSERT_EQ(run({"convert", source, target}).code, 0);
  const auto whole = std::chrono::steady_clock::now() - begun;
  const std::string fresh = read_file(target);
  const std::string old = "# the old one\n";
  std::mt19937_64 random(6);
  int olds = 0, news = 0;
  for (int i = 0; i < kills; ++i) {
    std::ofstream(target, std::ios::binary) << old;
    const pid_t child = start({"convert", source, target});
    std::this_thread::sleep_for(whole * static_cast<std::int64_t>(random() % 1000) / 1000);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    const std::string now = read_file(target);
    ASSERT_TRUE(now == old || now == fresh) << "kill " << i << " left " << now.size() << " bytes";
    ++(now == old ? olds : news);
  }
  RecordProperty("old", olds);
  RecordProperty("new", news);
  // Litter of a process that certainly was killed while it wrote.
  std::ofstream(folder / ".dmoscope-999999-0.tmp", std::ios::binary) << "half";
  ASSERT_EQ(run({"convert", source, target}).code, 0);
  EXPECT_EQ(names_in(folder / ""), (std::vector<std::string>{"source.off", "target.obj"}));
}

TEST(Checkpoint, GoesOnToTheSameBits) {
  const Folder folder;
  const std::string state = folder / "c.json";
  for (const std::vector<std::string>& goal :
       {std::vector<std::string>{"--iterations", "100"}, {"--until-converged", "--patience", "10", "--then", "mean"}}) {
    fs::remove(folder / "broken.14");  // left by a run that was not interrupted
    std::vector<std::string> common{"smooth", sample("coast.14")};
    common.insert(common.end(), goal.begin(), goal.end());
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), common.begin(), common.end());
      return more;
    };
    const Output whole = run(with({"-o", folder / "whole.14", "--json"}));
    Call call;
    call.arguments = with({"-o", folder / "broken.14", "--checkpoint", state, "--checkpoint-every", "0"});
    call.interrupt = std::chrono::milliseconds(250);
    call.signal = SIGTERM;
    const Output broken = run(call);
    if (broken.code == 0) continue;  // the machine was too fast
    EXPECT_EQ(broken.code, 1) << broken.err;
    EXPECT_FALSE(exists(folder / "broken.14"));
    if (!exists(state)) continue;  // the machine was so slow that it was still reading
    const Output resumed = run(with({"-o", folder / "resumed.14", "--resume", state, "--json"}));
    EXPECT_EQ(resumed.code, whole.code) << resumed.err;
    EXPECT_EQ(read_file(folder / "resumed.14"), read_file(folder / "whole.14"));
    for (const char* key : {"iterations", "stopped", "last_rise", "before", "after"})
      EXPECT_EQ(json_of(resumed)[key], json_of(whole)[key]) << key;
    const Output other = run(with({"-o", folder / "other.14", "--resume", state, "--metric", "radius-ratio"}));
    EXPECT_EQ(other.code, 2);
    EXPECT_THAT(other.err, HasSubstr("give the options that this run was begun with"));
    EXPECT_FALSE(exists(folder / "other.14"));
    fs::remove(state);
  }
  EXPECT_EQ(run({"smooth", sample("coast.14"), "-o", folder / "x.14", "--resume", folder / "none"}).code, 3);
  EXPECT_EQ(run({"smooth", sample("coast.14"), "-o", folder / "x.14", "--checkpoint", folder / "x.14"}).code, 2);
}

TEST(Checkpoint, IsRefusedWhereGroupsOrSizesOfTheInputHaveChanged) {
  const Folder folder;
  // A grid of 6 x 6 squares in triangles; a nodestring through the middle (vertices 21, 22 ... from 1), and an elevation.
  const auto mesh = [](const std::string& string, double high) {
    std::string text = "MESH2D\n";
    for (int y = 0, e = 0; y < 6; ++y)
      for (int x = 0; x < 6; ++x) {
        const int a = y * 7 + x + 1;
        text += fmt::format("E3T {} {} {} {} 1\nE3T {} {} {} {} 1\n", e + 1, a, a + 1, a + 8, e + 2, a, a + 8, a + 7);
        e += 2;
      }
    for (int v = 0; v < 49; ++v)
      text += fmt::format("ND {} {} {} {}\n", v + 1, v % 7 + 0.3 * ((v * 5) % 7 < 3 && v % 7 > 0 && v % 7 < 6 ? 1 : 0), v / 7,
                          v == 24 ? high : 1.0 + v % 5);
    return text + string;
  };
  const std::string path = folder / "m.2dm", state = folder / "state";
  const auto put = [&](const std::string& bytes) { std::ofstream(path) << bytes; };
  const auto smooth = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"smooth", path, "--combine", "mean-ratio:0.3:density", "--size-function", "field:elevation"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  };
  const std::string inner = "NS 23 24 -25\n";
  put(mesh(inner, 3));
  ASSERT_EQ(smooth({"-o", folder / "whole.2dm", "--iterations", "9"}).code, 0);
  ASSERT_EQ(smooth({"-o", folder / "some.2dm", "--iterations", "4", "--checkpoint", state, "--checkpoint-every", "0"}).code, 0);
  const std::string later = folder / "later.2dm";
  const auto resume = [&] { return smooth({"-o", later, "--iterations", "9", "--resume", state}); };
  EXPECT_EQ(resume().code, 0);
  EXPECT_EQ(read_file(later), read_file(folder / "whole.2dm"));
  EXPECT_NE(read_file(later), read_file(folder / "some.2dm"));
  fs::remove(later);
  put(mesh("NS 24 25 -26\n", 3));
  Output refused = resume();
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, HasSubstr("other vertices keep their place now"));
  EXPECT_THAT(refused.err, HasSubstr("has changed)"));
  put(mesh(inner, 3.5));
  refused = resume();
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, HasSubstr("the sizes wanted, its field \"elevation\", are others"));
  EXPECT_FALSE(exists(later));

  put(mesh(inner, 3));
  ASSERT_EQ(
      smooth({"-o", folder / "s.2dm", "--iterations", "4", "--checkpoint", state, "--checkpoint-every", "0", "--fix", "elevation=2"}).code,
      0);
  put(mesh(inner, 2));
  refused = smooth({"-o", later, "--iterations", "9", "--resume", state, "--fix", "elevation=2"});
  EXPECT_NE(refused.code, 0);
  EXPECT_FALSE(exists(later));
  put(mesh(inner, 3));
  refused = smooth({"-o", later, "--iterations", "9", "--resume", state, "--fix", "elevation=3"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--fix names other vertices"));
}

TEST(Build, TheProgramMovesAboutAndItsTablesCannotBeWritten) {
  const std::string bytes = read_file(DMOSCOPE_PROGRAM);
  Elf64_Ehdr head;
  ASSERT_GE(bytes.size(), sizeof head);
  std::memcpy(&head, bytes.data(), sizeof head);
  if (head.e_ident[EI_CLASS] != ELFCLASS64) GTEST_SKIP() << "no 64-bit program";
  EXPECT_EQ(head.e_type, ET_DYN) << "position independent";
  bool read_only = false, at_once = false;
  for (std::size_t i = 0; i < head.e_phnum; ++i) {
    Elf64_Phdr part;
    std::memcpy(&part, bytes.data() + head.e_phoff + i * sizeof part, sizeof part);
    read_only = read_only || part.p_type == PT_GNU_RELRO;
    for (std::size_t at = 0; part.p_type == PT_DYNAMIC && at < part.p_filesz; at += sizeof(Elf64_Dyn)) {
      Elf64_Dyn entry;
      std::memcpy(&entry, bytes.data() + part.p_offset + at, sizeof entry);
      at_once = at_once || (entry.d_tag == DT_FLAGS_1 && (entry.d_un.d_val & DF_1_NOW) != 0);
    }
  }
  EXPECT_TRUE(read_only);
  EXPECT_TRUE(at_once);
}

TEST(Provenance, SaysWhichFileWhichProgramAndWhatItWasTold) {
  const Folder folder;
  const std::string in = folder.file("in.off", kTwoTriangles), out = folder / "out.off";
  const Output output = run({"smooth", in, "-o", out, "--iterations", "2", "--json", "--provenance"});
  ASSERT_EQ(output.code, 0) << output.err;
  const auto provenance = json_of(output)["provenance"];
  EXPECT_EQ(provenance["input_sha256"], "80b1e512ced8b12dde281a0cadee5d64ca139aec3720bc3c2e8f5f1ee20daa71");
  EXPECT_THAT(provenance["command"].get<std::string>(), HasSubstr("--iterations 2"));
  EXPECT_FALSE(provenance["version"].get<std::string>().empty());
  const std::string bytes = read_file(out);
  EXPECT_THAT(bytes, HasSubstr("# made by dmoscope"));
  EXPECT_THAT(bytes, HasSubstr("80b1e512ced8b12dde281a0cadee5d64ca139aec3720bc3c2e8f5f1ee20daa71"));
  EXPECT_EQ(run({"smooth", in, "-o", folder / "plain.off", "--iterations", "2"}).code, 0);
  EXPECT_EQ(bytes.substr(0, bytes.find("# made by")), read_file(folder / "plain.off")) << "nothing else differs";
  const Output compared = run({"compare", in, "--run", "dmo", "--iterations", "1", "--json"});
  EXPECT_EQ(json_of(compared)["provenance"]["input_sha256"], "80b1e512ced8b12dde281a0cadee5d64ca139aec3720bc3c2e8f5f1ee20daa71");
}

}  // namespace
}  // namespace dmoscope::test
