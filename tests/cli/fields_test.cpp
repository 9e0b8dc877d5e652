// Data of places stay with places.

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;

/// A square of two by two, whose middle is out of place; the depth is 10 x.
std::string ramp() {
  return "depth is 10 times x everywhere\n8 9\n1 0 0 0\n2 1 0 10\n3 2 0 20\n4 0 1 0\n5 1.6 1.3 16\n6 2 1 20\n7 0 2 0\n8 1 2 10\n9 2 2 20\n"
         "1 3 1 2 5\n2 3 1 5 4\n3 3 2 3 6\n4 3 2 6 5\n5 3 4 5 8\n6 3 4 8 7\n7 3 5 6 9\n8 3 5 9 8\n0\n0\n0\n0\n";
}

struct Node {
  double x, y, depth;
};
Node fifth_node(const std::string& file) {
  std::istringstream line(lines_of(read_file(file)).at(6));
  int number = 0;
  Node node{};
  line >> number >> node.x >> node.y >> node.depth;
  EXPECT_EQ(number, 5);
  return node;
}

TEST(Fields, ADepthIsThatOfThePlace) {
  const Folder folder;
  const std::string in = folder.file("ramp.14", ramp()), out = folder / "out.14", carried = folder / "carried.14";
  const auto json = smooth(in, out, {"--iterations", "5"});
  const Node node = fifth_node(out);
  EXPECT_LT(node.x, 1.5);
  EXPECT_NEAR(node.depth, 10.0 * node.x, 1e-12);
  EXPECT_EQ(json["fields"]["placed"], nlohmann::json({"depth"}));
  EXPECT_EQ(json["fields"]["carried"], nlohmann::json::array());
  EXPECT_EQ(json["parameters"]["fields"], "place");
  const auto other = smooth(in, carried, {"--iterations", "5", "--fields", "depth=carry"});
  const Node same = fifth_node(carried);
  EXPECT_EQ(same.x, node.x);
  EXPECT_EQ(same.depth, 16.0);
  EXPECT_EQ(other["fields"]["carried"], nlohmann::json({"depth"}));
  // Lines of unmoved vertices are unchanged.
  const auto before = lines_of(ramp()), after = lines_of(read_file(out));
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    if (i != 6) {
      EXPECT_EQ(after[i], before[i]);
    }
}

TEST(Fields, ItIsSaidWhatBecameOfThem) {
  const Folder folder;
  const std::string in = folder.file("ramp.14", ramp()), out = folder / "out.14";
  EXPECT_THAT(run({"smooth", in, "-o", out}).out, HasSubstr("fields: depth was taken anew at the new places"));
  EXPECT_THAT(run({"smooth", in, "-o", out, "--fields", "carry"}).out, HasSubstr("fields: depth was carried"));
  const Output wrong = run({"smooth", in, "-o", out, "--fields", "dept=carry"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean depth?"));
  EXPECT_EQ(run({"smooth", in, "-o", out, "--fields", "keep"}).code, 2);
}

TEST(Fields, ASessionExportsThemSo) {
  const Folder folder;
  const std::string in = folder.file("ramp.14", ramp()), placed = folder / "placed.14", carried = folder / "carried.14";
  const std::string script = folder.file(
      "script.txt", "open " + in + "\nstep iteration 5\nexport " + placed + "\nfields carry\nstep iteration 5\nexport " + carried + "\n");
  const Output output = run({"script", script});
  EXPECT_EQ(output.code, 0) << output.err;
  EXPECT_NEAR(fifth_node(placed).depth, 10.0 * fifth_node(placed).x, 1e-12);
  EXPECT_EQ(fifth_node(carried).depth, 16.0);
}

}  // namespace
}  // namespace dmoscope::test
