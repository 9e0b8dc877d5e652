// Sessions saved and opened: every run at its moment, bit for bit; nothing half opened; no file does harm.

#include "core/session/state_file.h"

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/same_bits.h"
#include "core/commands/session_commands.h"
#include "core/engine/engine.h"
#include "core/session/json_values.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

/// The session as saved before there were checksums, which would be the first to refuse.
Json unsealed(Json json) {
  json["version"] = 1;
  json.erase("checksums");
  for (Json& run : json["runs"]) run.erase("checksums");
  return json;
}

class StateFile : public ::testing::Test {
 protected:
  StateFile() { add_session_commands(commands_, context_); }
  void say(const std::string& line) { commands_.execute(line); }
  [[nodiscard]] std::string text() const {
    std::ifstream stream(file_);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void write(const std::string& text) const { std::ofstream(file_) << text; }
  /// The error message of opening; empty: it opens.
  std::string refusal() {
    Session other(1);
    try {
      open_state(file_, other, progress_);
    } catch (const InputError& error) {
      EXPECT_FALSE(other.has_input()) << "nothing is half opened";
      return error.what();
    }
    return {};
  }

  const test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "session.json";
  Session session_{2};
  Progress progress_;
  CommandContext context_{session_, progress_, [](const Message&) {}};
  CommandTable commands_;
};

TEST_F(StateFile, OpensWhatWasSavedBitForBit) {
  say("generate random 300 7");
  say("precision double");
  const auto vertex = session_.active().colouring().order[3];
  say("fix " + std::to_string(vertex));
  say("run 2");
  say("visit 0-299");
  say("run 2");
  say("step class 2");
  say("visit 0-299");
  say("add-run dmo:radius-ratio");
  say("order shuffle:5");
  say("step vertex 5");
  say("add-run dmo:min-angle");
  say("run 3");
  say("seek 1");
  say("add-run dvr:mean-ratio");
  say("directions axes");
  say("seed 18446744073709551615");
  say("run 2");
  say("add-run angle-based:mean-ratio");
  say("relaxation 0.3");
  say("run 2");
  say("select-run 2");
  say("show min-angle");
  say("save-state " + file_.string() + R"( "{\"zoom\": 2}")");
  Session other(1);
  open_state(file_, other, progress_);
  ASSERT_EQ(other.run_count(), session_.run_count());
  EXPECT_EQ(other.active_index(), 1U);
  EXPECT_EQ(other.shown(), Metric::MinAngle);
  EXPECT_EQ(Json::parse(other.restored_view()), Json::parse("{\"zoom\": 2}"));
  EXPECT_EQ(other.restored_views(), 1U);
  for (std::size_t i = 0; i < other.run_count(); ++i) {
    dmoscope::Run &a = session_.run(i), &b = other.run(i);
    EXPECT_EQ(a.title(), b.title());
    EXPECT_EQ(a.moment(), b.moment());
    EXPECT_EQ(a.parameters().fixed, b.parameters().fixed);
    EXPECT_EQ(a.parameters().search, b.parameters().search);
    EXPECT_EQ(a.parameters().options, b.parameters().options);
    EXPECT_EQ(a.parameters().order, b.parameters().order);
    EXPECT_EQ(a.edits().all(), b.edits().all());
    EXPECT_TRUE(same_bits(a.positions(), b.positions())) << i;
    ASSERT_EQ(a.history().records().size(), b.history().records().size());
    for (std::size_t k = 0; k < a.history().records().size(); ++k) {
      EXPECT_EQ(a.history().records()[k].statistics.mean, b.history().records()[k].statistics.mean);
      EXPECT_EQ(a.history().records()[k].statistics.worst_element, b.history().records()[k].statistics.worst_element);
      EXPECT_EQ(a.history().records()[k].moved, b.history().records()[k].moved);
      a.seek({k}, progress_);
      b.seek({k}, progress_);
      EXPECT_TRUE(same_bits(a.positions(), b.positions())) << "run " << i << ", iteration " << k;
    }
  }
}

TEST_F(StateFile, FindsTheMeshAgainAndRefusesAnother) {
  const auto mesh = folder_ / "mesh.off";
  say("generate annulus 200");
  say("export " + mesh.string());
  say("open " + mesh.string());
  say("run 2");
  say("save-state " + file_.string());
  EXPECT_EQ(refusal(), "");
  // Both files were moved elsewhere.
  const auto elsewhere = folder_ / "elsewhere";
  std::filesystem::create_directories(elsewhere);
  std::filesystem::rename(mesh, elsewhere / "mesh.off");
  EXPECT_THAT(refusal(), HasSubstr("mesh.off"));
  std::filesystem::rename(file_, elsewhere / "session.json");
  file_ = elsewhere / "session.json";
  EXPECT_EQ(refusal(), "");
  say("export " + (elsewhere / "mesh.off").string());  // smoothed: other positions
  EXPECT_THAT(refusal(), HasSubstr("has changed since the session was saved"));
}

/// Two rows of squares, each of two triangles; elements of the lower row are material `lower`, of the upper one `upper`, but for the last.
std::string two_rows(int lower, int upper, int last, const char* points, double depth = 4.0) {
  std::string text = "# vtk DataFile Version 3.0\nrows\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 15 double\n";
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) text += std::to_string(x) + (y == 1 && x == 2 ? " 1.3 0\n" : " " + std::to_string(y) + " 0\n");
  text += "CELLS 16 64\n";
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) {
      const auto at = [&](int i, int j) { return std::to_string((y + j) * 5 + x + i) + " "; };
      text += "3 " + at(0, 0) + at(1, 0) + at(1, 1) + "\n3 " + at(0, 0) + at(1, 1) + at(0, 1) + "\n";
    }
  text += "CELL_TYPES 16\n";
  for (int e = 0; e < 16; ++e) text += "5\n";
  text += std::string("CELL_DATA 16\nSCALARS mat_id int\nLOOKUP_TABLE default\n");
  for (int e = 0; e < 16; ++e) text += std::to_string(e == 15 ? last : e < 8 ? lower : upper) + "\n";
  text += std::string("POINT_DATA 15\nSCALARS ") + points + " double\nLOOKUP_TABLE default\n";
  for (int v = 0; v < 15; ++v) text += std::to_string(v == 7 ? depth : 1.0 + v % 3) + "\n";
  return text;
}

TEST_F(StateFile, RefusesAMeshWhoseMaterialsHoldOtherVertices) {
  const auto mesh = folder_ / "mesh.vtk";
  const auto put = [&](const std::string& bytes) { std::ofstream(mesh) << bytes; };
  put(two_rows(1, 1, 1, "depth"));
  say("open " + mesh.string());
  say("run 2");
  say("save-state " + file_.string());
  EXPECT_EQ(refusal(), "");
  put(two_rows(1, 1, 1, "depth", 8.0));
  EXPECT_EQ(refusal(), "") << "a field that nothing reads may change";
  put(two_rows(3, 3, 3, "depth"));
  EXPECT_EQ(refusal(), "") << "the number of a material alone holds nothing";
  put(two_rows(1, 2, 2, "depth"));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("other vertices keep their place now"), HasSubstr("field \"mat_id\" has changed")));
  say("interfaces free");
  say("run 2");
  say("save-state " + file_.string());
  put(two_rows(1, 1, 1, "depth"));
  EXPECT_EQ(refusal(), "") << "where interfaces are free it does not matter";
}

TEST_F(StateFile, RefusesAMeshThatWantsOtherSizes) {
  const auto mesh = folder_ / "mesh.vtk";
  const auto put = [&](const std::string& bytes) { std::ofstream(mesh) << bytes; };
  put(two_rows(1, 1, 1, "depth"));
  say("open " + mesh.string());
  say("combine mean-ratio:0.2:density field:depth");
  say("run 2");
  say("save-state " + file_.string());
  EXPECT_EQ(refusal(), "");
  put(two_rows(2, 2, 2, "depth"));
  EXPECT_EQ(refusal(), "");
  put(two_rows(1, 1, 1, "depth", 4.5));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("sizes wanted"), HasSubstr("\"depth\"")));
}

TEST_F(StateFile, RefusesTheSameNumbersIn32Bits) {
  const auto mesh = folder_ / "mesh.off";
  const auto put = [&](const std::string& bytes) { std::ofstream(mesh, std::ios::binary) << bytes; };
  put("OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.25 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n");
  say("open " + mesh.string());
  say("run 1");
  say("save-state " + file_.string());
  EXPECT_EQ(refusal(), "");
  std::string binary = "OFF BINARY\n";
  const auto add = [&](std::uint32_t bits) {
    for (int shift = 24; shift >= 0; shift -= 8) binary += static_cast<char>(bits >> shift & 255U);
  };
  for (const std::uint32_t n : {5U, 4U, 0U}) add(n);
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 1.F, 0.F, 0.F, 1.F, 0.F, 0.5F, 0.25F, 0.F}) add(std::bit_cast<std::uint32_t>(x));
  for (const std::uint32_t n : {3U, 0U, 1U, 4U, 0U, 3U, 1U, 2U, 4U, 0U, 3U, 2U, 3U, 4U, 0U, 3U, 3U, 0U, 4U, 0U}) add(n);
  put(binary);
  EXPECT_THAT(refusal(), HasSubstr("32-bit coordinates now"));
}

TEST_F(StateFile, NobodyCouldFindAMeshThatCameFromNowhere) {
  session_.open(testing::lattice(5, 0.1, 1), progress_);
  EXPECT_THROW(say("save-state " + file_.string()), UsageError);
  EXPECT_FALSE(std::filesystem::exists(file_));
  say("generate random 100");
  EXPECT_THROW(say("save-state " + file_.string() + " {zoom"), UsageError) << "a view that is no JSON";
  EXPECT_THROW(say("save-state /no/such/folder/x.json"), OutputError);
}

TEST_F(StateFile, AFileOfBeforeMethodsHadOptionsStillOpens) {
  say("generate random 100");
  say("run 2");
  say("save-state " + file_.string());
  Json json = unsealed(Json::parse(text()));
  Json& parameters = json["runs"][0]["parameters"];
  for (const char* key : {"relaxation", "directions", "seed"}) EXPECT_EQ(parameters.erase(key), 1U) << key;
  write(json.dump());
  EXPECT_EQ(refusal(), "");
  Session other(1);
  open_state(file_, other, progress_);
  EXPECT_EQ(other.active().parameters().options, MethodOptions{});
  parameters["relaxation"] = 2.0;
  write(json.dump());
  EXPECT_THAT(refusal(), HasSubstr("relaxation"));
}

TEST_F(StateFile, CanBeUndone) {
  say("generate random 100");
  say("run 1");
  say("save-state " + file_.string());
  say("generate grid 400");
  const auto grid = session_.input();
  say("open-state " + file_.string());
  EXPECT_EQ(session_.active().moment(), Moment{1});
  say("undo");
  EXPECT_EQ(session_.input(), grid);
}

TEST_F(StateFile, MalformedFilesAreRefusedWithAReason) {
  say("generate random 100");
  say("run 2");
  say("visit 0-99");
  say("step vertex");
  say("save-state " + file_.string());
  const std::string good = text();
  const Json json = unsealed(Json::parse(good));
  EXPECT_EQ(refusal(), "");

  write("");
  EXPECT_THAT(refusal(), HasSubstr("session.json:1: this is not a saved session: it is not JSON"));
  write("{\n\"format\": 1,,\n");
  EXPECT_THAT(refusal(), HasSubstr("session.json:2: "));
  write(std::string(100000, '['));
  EXPECT_THAT(refusal(), HasSubstr("nested too deeply"));
  std::string deep = good;
  deep.insert(deep.rfind('}'), ",\"view\":" + std::string(400000, '[') + std::string(400000, ']'));
  write(deep);
  EXPECT_THAT(refusal(), HasSubstr("nested too deeply"));
  for (const char* other : {"1", "null", "[]", "{}", "\"x\"", "{\"format\": 7}", "{\"format\": \"dmoscope session\"}"}) {
    write(other);
    EXPECT_NE(refusal(), "") << other;
  }
  // Every value in turn is replaced, or removed.
  const Json flat = json.flatten();
  const std::vector<Json> wrong{Json(), Json(-1), Json(1e300), Json("x"), Json::array(), Json::object(), Json(18446744073709551615ULL)};
  std::size_t refused = 0, tried = 0;
  std::size_t number = 0;
  for (const auto& item : flat.items()) {
    if (testing::kSanitized && number++ % 4 != 0) continue;
    if (item.key().find("/records/") != std::string::npos && item.key().find("/records/1") == std::string::npos) continue;
    for (const Json& value : wrong) {
      Json broken = json;
      broken[Json::json_pointer(item.key())] = value;
      write(broken.dump());
      ++tried;
      refused += refusal().empty() ? 0U : 1U;
    }
    for (auto pointer = Json::json_pointer(item.key()); !pointer.empty(); pointer = pointer.parent_pointer()) {
      Json broken = json;
      Json& parent = broken[pointer.parent_pointer()];
      if (parent.is_array())
        parent.erase(static_cast<std::size_t>(std::stoul(pointer.back())));
      else
        parent.erase(pointer.back());
      write(broken.dump());
      (void)refusal();
    }
  }
  EXPECT_GT(refused * 10, tried * 6) << "most of them matter";
  // The file is cut off anywhere.
  for (std::size_t length = 0; length < good.size() - 2; length += 1 + good.size() / 97) {
    write(good.substr(0, length));
    EXPECT_NE(refusal(), "") << length;
  }
}

TEST_F(StateFile, RefusesWhatCannotHaveBeen) {
  say("generate random 100");
  say("run 2");
  say("visit 0-99");
  say("save-state " + file_.string());
  const Json json = unsealed(Json::parse(text()));
  const auto refused = [&](const char* pointer, const Json& value) {
    Json broken = json;
    broken[Json::json_pointer(pointer)] = value;
    write(broken.dump());
    return refusal();
  };
  EXPECT_THAT(refused("/runs/0/moment", Json{9, 0, 0}), HasSubstr("no record"));
  EXPECT_THAT(refused("/runs/0/moment", Json{2, 0, 9}), HasSubstr("visit"));
  EXPECT_THAT(refused("/runs/0/moment", Json{2, 1000000, 0}), HasSubstr("visits"));
  EXPECT_THAT(refused("/runs/0/edits/0/at", Json{2, 0, 1}), HasSubstr("cannot be"));
  EXPECT_THAT(refused("/runs/0/edits/0/vertices", Json{1000000}), HasSubstr("1000000"));
  EXPECT_THAT(refused("/runs/0/positions", "AAAA"), HasSubstr("damaged"));
  EXPECT_THAT(refused("/version", 5), HasSubstr("version 5"));
  EXPECT_THAT(refused("/active", 1), HasSubstr("run 1 is active"));
  std::vector<Vec3> moved(session_.input()->mesh.positions);
  for (Vec3& p : moved) p.x += 1.0;
  EXPECT_THAT(refused("/runs/0/positions", pack_positions(moved)), HasSubstr("is fixed, but has moved"));
}

TEST_F(StateFile, SaysWhatIsDamaged) {
  say("generate random 100");
  say("run 2");
  say("visit 0-99");
  say("add-run dmo:radius-ratio");
  say("run 1");
  say("save-state " + file_.string());
  const Json json = Json::parse(text());
  const auto refused = [&](const char* pointer, const Json& value) {
    Json broken = json;
    broken[Json::json_pointer(pointer)] = value;
    write(broken.dump());
    return refusal();
  };
  write(json.dump(4));
  EXPECT_EQ(refusal(), "") << "how the file is laid out does not matter";
  EXPECT_THAT(refused("/runs/1/positions", pack_positions(session_.input()->mesh.positions)), HasSubstr("run 2 is damaged: its positions"));
  EXPECT_THAT(refused("/runs/0/parameters/grid", 9), HasSubstr("run 1 is damaged: its parameters"));
  EXPECT_THAT(refused("/runs/0/records/1/2", 0.25), HasSubstr("run 1 is damaged: its records"));
  EXPECT_THAT(refused("/runs/0/moment", Json{1, 0, 0}), HasSubstr("run 1 is damaged: its moment"));
  EXPECT_THAT(refused("/runs/0/edits", Json::array()), HasSubstr("run 1 is damaged: its edits"));
  EXPECT_THAT(refused("/active", 0), HasSubstr("its active"));
  EXPECT_THAT(refused("/shown", "min-angle"), HasSubstr("its shown"));
  EXPECT_THAT(refused("/input/elements", 7), HasSubstr("its input"));
  EXPECT_THAT(refused("/version", 1), HasSubstr("its version"));
  EXPECT_THAT(refused("/checksums", nullptr), HasSubstr("damaged"));
  Json without = json;
  without["runs"][0].erase("edits");
  write(without.dump());
  EXPECT_THAT(refusal(), HasSubstr("run 1 is damaged: its edits are missing"));
}

TEST_F(StateFile, NoChangedCharacterPasses) {
  say("generate grid 16");
  say("run 2");
  say("save-state " + file_.string());
  const std::string good = text();
  Session whole(1);
  (void)open_state(file_, whole, progress_);
  for (std::size_t i = 0; i < good.size(); i += 7) {
    std::string bad = good;
    bad[i] = bad[i] == '4' ? '5' : '4';
    if (Json::parse(bad, nullptr, false) == Json::parse(good)) continue;  // the last digit of a number without effect
    write(bad);
    EXPECT_NE(refusal(), "") << i << ": " << good.substr(i - std::min<std::size_t>(i, 20), 40);
  }
}

TEST_F(StateFile, OfBeforeThereWereChecksumsOpensWithANote) {
  say("generate random 100");
  say("run 2");
  say("save-state " + file_.string());
  Session other(1);
  EXPECT_EQ(open_state(file_, other, progress_), "");
  const Json json = unsealed(Json::parse(text()));
  write(json.dump());
  EXPECT_THAT(open_state(file_, other, progress_), HasSubstr("without checksums"));
  // Even then the positions must have the quality of the record.
  std::vector<Vec3> moved(other.active().positions().begin(), other.active().positions().end());
  const Index free = other.active().colouring().order.front();
  moved[free].x += 0.01;
  Json broken = json;
  broken["runs"][0]["positions"] = pack_positions(moved);
  write(broken.dump());
  EXPECT_THAT(refusal(), HasSubstr("a run is damaged: at iteration 2 its positions have"));
  moved[free].x = std::numeric_limits<double>::quiet_NaN();
  broken["runs"][0]["positions"] = pack_positions(moved);
  write(broken.dump());
  EXPECT_THAT(refusal(), HasSubstr("the positions of a run are damaged"));
}

TEST_F(StateFile, ARunThatCannotBeComputedAgainIsNotSavedAsIfItCould) {
  say("generate random 100");
  say("run 2");
  say("step vertex 3");
  say("save-state " + file_.string());
  Json json = unsealed(Json::parse(text()));
  json["runs"][0]["parameters"]["grid"] = 5;  // simulates another version whose search differs
  write(json.dump());
  Session other(1);
  other.set_history_budget(0);
  open_state(file_, other, progress_);
  EXPECT_THROW(save_state(file_, other, {}, progress_), UsageError);
  EXPECT_EQ(text(), json.dump()) << "what is there stays";
}

TEST_F(StateFile, NothingTakesThePlaceOfAMeshThatIsOpen) {
  const auto mesh = folder_ / "mesh.node";
  say("generate random 50");
  say("export " + mesh.string());
  say("open " + (folder_ / "mesh.ele").string());
  const auto bytes = [](const std::filesystem::path& path) {
    std::ifstream stream(path);
    return std::string{std::istreambuf_iterator<char>(stream), {}};
  };
  const std::string before = bytes(mesh), elements = bytes(folder_ / "mesh.ele");
  std::filesystem::create_symlink("mesh.node", folder_ / "link.csv");
  for (const char* verb : {"stats", "elements", "export", "save-state"})
    for (const char* name : {"mesh.node", "mesh.ele", "./mesh.ele", "link.csv"})
      EXPECT_THROW(say(std::string(verb) + " " + (folder_ / name).string()), UsageError) << verb << " " << name;
  say("generate grid 16");
  EXPECT_THROW(say("stats " + mesh.string()), UsageError) << "it was opened before";
  EXPECT_EQ(bytes(mesh), before);
  EXPECT_EQ(bytes(folder_ / "mesh.ele"), elements);
  say("save-state " + file_.string());
  say("open-state " + file_.string());
  EXPECT_NO_THROW(say("save-state " + file_.string())) << "a session may be saved again";
}

TEST_F(StateFile, ARunGoesOnFromItsFileAsIfItHadNotStopped) {
  for (const bool until_converged : {false, true}) {
    constexpr ConvergenceLimits kLimits{.patience = 4, .max_iterations = 60, .rise = 1e-3};
    const auto go = [&](dmoscope::Run& run, const dmoscope::Run::AfterIteration& after) {
      return until_converged ? run.until_converged_from_input(kLimits, progress_, after) : run.iterate_from_input(12, progress_, after);
    };
    say("generate random 200 3");
    say("then mean 5");
    const Outcome whole = go(session_.active(), [&](const dmoscope::Run& run) {
      if (run.moment() == Moment{6}) save_state(file_, session_, {}, progress_);
    });
    Session other(1);
    other.set_history_budget(0);
    (void)open_state(file_, other, progress_, session_.input());
    ASSERT_EQ(other.active().moment(), Moment{6});
    EXPECT_EQ(other.input(), session_.input());
    std::uint64_t heard = 0;
    const Outcome resumed = go(other.active(), [&](const dmoscope::Run&) { ++heard; });
    EXPECT_EQ(resumed.sentence(), whole.sentence());
    EXPECT_EQ(resumed.iterations, whole.iterations);
    EXPECT_EQ(heard, whole.iterations - 6);
    EXPECT_TRUE(same_bits(other.active().positions(), session_.active().positions()));
  }
}

TEST_F(StateFile, ACancelledOpeningLeavesTheSession) {
  say("generate random 2000");
  say("run 2");
  say("step class");
  say("save-state " + file_.string());
  say("generate grid 400");
  const auto grid = session_.input();
  progress_.request_cancel();
  EXPECT_THROW(say("open-state " + file_.string()), Cancelled);
  progress_.clear_cancel();
  EXPECT_EQ(session_.input(), grid);
}

}  // namespace
}  // namespace dmoscope
