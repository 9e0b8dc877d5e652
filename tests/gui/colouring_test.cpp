// Colours, filters and labels: effects of the commands, values that elements are coloured by, and the window's handles and legends.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/gui/headless_test.h"
#include "tests/support/meshes.h"
#include "tests/support/picture_difference.h"
#include "ui/analysis/counting_elements.h"
#include "ui/analysis/derived.h"
#include "ui/analysis/element_colours.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

/// A frame of a mesh with these qualities, nothing inverted.
std::shared_ptr<Frame> frame_of(const std::shared_ptr<const InputMesh>& input, std::vector<float> quality, std::uint64_t serial,
                                std::uint64_t input_serial = 1) {
  auto frame = std::make_shared<Frame>();
  frame->serial = serial;
  frame->input_serial = input_serial;
  frame->input = input;
  frame->positions = input->mesh.positions;
  frame->quality = std::move(quality);
  frame->inverted.assign(frame->quality.size(), 0);
  return frame;
}

TEST(ColourRange, ExpandingHoldsAllThatWasSeenAndNeverShrinks) {
  const auto input = testing::input(testing::lattice(4, 0.2, 3));
  testing::Random random(7);
  ViewState state;
  state.range_mode = RangeMode::Expanding;
  Derived derived;
  double least = INFINITY, largest = -INFINITY;
  std::pair<double, double> before{INFINITY, -INFINITY};
  std::vector<float> quality(input->mesh.elements.size());
  for (std::uint64_t serial = 1; serial <= 30; ++serial) {
    const double low = random(0.0, 0.9), high = low + random(0.01, 1.0 - low);
    for (float& q : quality) q = static_cast<float>(random(low, high));
    for (const float q : quality) {
      least = std::min(least, static_cast<double>(q));
      largest = std::max(largest, static_cast<double>(q));
    }
    SessionView session;
    session.frame = frame_of(input, quality, serial);
    if (serial % 7 == 0) state.range_mode = RangeMode::Fixed;  // qualities seen meanwhile count, too
    refresh(derived, state, session);
    if (serial % 7 == 0) {
      state.range_mode = RangeMode::Expanding;
      refresh(derived, state, session);
    }
    EXPECT_EQ(derived.range.first, least);
    EXPECT_EQ(derived.range.second, largest);
    EXPECT_LE(derived.range.first, before.first);
    EXPECT_GE(derived.range.second, before.second);
    EXPECT_EQ(derived.outside_low + derived.outside_high, 0U);
    before = derived.range;
  }
  // Another input starts without seen qualities.
  SessionView session;
  quality.assign(quality.size(), 0.5F);
  quality[0] = 0.4F;
  session.frame = frame_of(input, quality, 99, 2);
  refresh(derived, state, session);
  EXPECT_EQ(derived.range, (std::pair{static_cast<double>(0.4F), 0.5}));
}

TEST(ColourRange, OutsideAndFilteredElementsAreCounted) {
  const auto input = testing::input(testing::lattice(4, 0.0, 3));
  std::vector<float> quality(input->mesh.elements.size(), 0.5F);
  quality[0] = 0.1F;
  quality[1] = 0.9F;
  quality[2] = 0.95F;
  quality[3] = -0.3F;
  quality[4] = NAN;
  SessionView session;
  const auto frame = frame_of(input, quality, 1);
  frame->inverted[3] = 1;
  session.frame = frame;
  ViewState state;
  state.range_mode = RangeMode::Given;
  state.range_low = 0.2;
  state.range_high = 0.8;
  Derived derived;
  refresh(derived, state, session);
  EXPECT_EQ(derived.outside_low, 1U) << "the inverted one is not among them";
  EXPECT_EQ(derived.outside_high, 2U);
  EXPECT_TRUE(derived.undefined);
  EXPECT_FALSE(derived.colouring.counting.has_value()) << "all count";
  state.colouring.filter = {0.0, 0.5};
  refresh(derived, state, session);
  EXPECT_EQ(derived.colouring.counting, quality.size() - 3) << "all but two good ones and the one without a quality";
  state.colouring.filter = {0.4, 0.5};
  refresh(derived, state, session);
  EXPECT_EQ(derived.colouring.counting, quality.size() - 5);
}

TEST(ColourScales, AreOneForAll) {
  ViewState state;
  state.colour_map = render::ColourMap::Magma;
  state.colouring.reversed = true;
  state.colouring.steps = 5;
  Derived derived;
  derived.range = {0.2, 0.7};
  const render::ColourScale scale = colour_scale(state, derived);
  EXPECT_EQ(scale, (render::ColourScale{render::ColourMap::Magma, true, 5, 0.2, 0.7}));
  EXPECT_EQ(shown_scale(state, derived), scale);
  EXPECT_EQ(scale.colour(0.25), render::sample(render::ColourMap::Magma, 1.0)) << "the first of five steps, reversed";
  auto colours = std::make_shared<ElementColours>();
  colours->range = {3, 9};
  derived.colouring.colours = colours;
  EXPECT_EQ(shown_scale(state, derived).high, 9.0);
  EXPECT_EQ(colour_scale(state, derived).high, 0.7) << "quality keeps its own";
}

/// A mesh of both kinds with a group of elements, one of vertices and one of edges.
std::shared_ptr<const InputMesh> grouped(bool with_elements) {
  Mesh mesh = testing::lattice(8, 0.25, 11, testing::Cells::Mixed);
  mesh.groups.push_back({"south", "open boundary", 0, 0, {0, 1, 2, 3}});
  mesh.groups.push_back({"west", "marker", 0, 1, {0, 9, 9, 18}});
  if (with_elements) mesh.groups.push_back({"core", "set", 0, 2, {5, 6, 7}});
  return testing::input(std::move(mesh));
}

ElementColours colours_of(ColourBy by, const std::shared_ptr<Frame>& frame, std::shared_ptr<const Colouring> classes = nullptr) {
  return colour_elements({by, frame, std::move(classes), render::ColourMap::Viridis, false});
}

std::size_t total(const ElementColours& colours) {
  std::size_t sum = 0;
  for (const Category& category : colours.categories) sum += category.count;
  return sum;
}

TEST(ElementColours, KindsAndValences) {
  const auto input = grouped(false);
  const Mesh& mesh = input->mesh;
  const auto frame = frame_of(input, std::vector<float>(mesh.elements.size(), 0.5F), 1);
  const ElementColours kinds = colours_of(ColourBy::Kind, frame);
  ASSERT_EQ(kinds.categories.size(), 2U);
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto category = static_cast<std::size_t>(kinds.shading->values[e]);
    EXPECT_EQ(kinds.categories[category].name, mesh.elements.corners(e).size() == 3 ? "triangle" : "quadrilateral");
  }
  EXPECT_EQ(total(kinds), mesh.elements.size());

  std::vector<std::size_t> valence(mesh.positions.size(), 0);
  for (const Index v : mesh.elements.all_corners()) ++valence[v];
  const ElementColours valences = colours_of(ColourBy::Valence, frame);
  EXPECT_EQ(valences.shading->by, render::Shading::By::Vertices);
  for (std::size_t v = 0; v < valence.size(); ++v) {
    EXPECT_EQ(valences.categories[static_cast<std::size_t>(valences.shading->values[v])].name, std::to_string(valence[v]));
  }
  EXPECT_EQ(total(valences), valence.size());
  for (std::size_t k = 1; k < valences.categories.size(); ++k) {
    EXPECT_GT(render::to_oklab(valences.categories[k].colour).l, render::to_oklab(valences.categories[k - 1].colour).l)
        << "they have an order";
  }
}

TEST(ElementColours, ClassesAreThoseOfTheRun) {
  const auto input = grouped(false);
  const auto frame = frame_of(input, std::vector<float>(input->mesh.elements.size(), 0.5F), 1);
  std::vector<Index> free;
  for (Index v = 0; v < input->mesh.vertex_count(); ++v) {
    if (input->topology.boundary()[v] == 0) free.push_back(v);
  }
  const auto classes = std::make_shared<const Colouring>(colour_vertices(input->mesh, input->topology, free));
  const ElementColours colours = colours_of(ColourBy::Class, frame, classes);
  ASSERT_EQ(colours.categories.size(), classes->class_count());
  EXPECT_EQ(total(colours), free.size());
  const auto& values = colours.shading->values;
  for (Index e = 0; e < input->mesh.elements.size(); ++e) {
    const auto corners = input->mesh.elements.corners(e);
    for (const Index a : corners) {
      EXPECT_EQ(values[a] < 0, input->topology.boundary()[a] != 0);
      for (const Index b : corners) {
        EXPECT_TRUE(a == b || values[a] < 0 || values[a] != values[b]) << "two of one class share an element";
      }
    }
  }
}

TEST(ElementColours, GroupsByElementsOrByVertices) {
  const auto by_vertices = grouped(false), by_elements = grouped(true);
  const ElementColours vertices = colours_of(ColourBy::Group, frame_of(by_vertices, {}, 1));
  EXPECT_EQ(vertices.shading->by, render::Shading::By::Vertices);
  EXPECT_EQ(vertices.shading->values[2], 0.0F);
  EXPECT_EQ(vertices.shading->values[18], 1.0F);
  EXPECT_EQ(vertices.shading->values[0], 0.0F) << "the first of its groups";
  EXPECT_EQ(vertices.shading->values[40], -1.0F);
  const ElementColours elements = colours_of(ColourBy::Group, frame_of(by_elements, {}, 1));
  EXPECT_EQ(elements.shading->by, render::Shading::By::Elements);
  ASSERT_EQ(elements.categories.size(), 1U);
  EXPECT_EQ(elements.categories[0].count, 3U);
  EXPECT_EQ(elements.shading->values[6], 0.0F);
  EXPECT_EQ(elements.shading->values[8], -1.0F);
}

TEST(ElementColours, ManyGroupsAreGatheredByWhatTheyAre) {
  Mesh mesh = testing::lattice(20, 0.0, 1);
  for (int k = 0; k < 40; ++k) {
    mesh.groups.push_back({"land boundary " + std::to_string(k + 1), "land boundary", k % 2 == 0 ? 20 : 21, 0, {static_cast<Index>(k)}});
  }
  const ElementColours colours = colours_of(ColourBy::Group, frame_of(testing::input(std::move(mesh)), {}, 1));
  ASSERT_EQ(colours.categories.size(), 2U);
  EXPECT_EQ(colours.categories[1].name, "land boundary, type 21");
  EXPECT_EQ(colours.categories[1].count, 20U);
}

TEST(ElementColours, DisplacementAndSize) {
  const auto input = testing::input(testing::lattice(10, 0.0, 1, testing::Cells::Quadrilaterals));
  const Mesh& mesh = input->mesh;
  const auto frame = frame_of(input, std::vector<float>(mesh.elements.size(), 0.5F), 1);
  const ElementColours still = colours_of(ColourBy::Displacement, frame);
  EXPECT_EQ(*std::max_element(still.shading->values.begin(), still.shading->values.end()), 0.0F);
  const ElementColours even = colours_of(ColourBy::Size, frame);
  EXPECT_TRUE(even.logarithmic);
  for (const float value : even.shading->values) EXPECT_NEAR(static_cast<double>(value), 0.0, 1e-6);
  const Index moved = 5 * 11 + 5;
  frame->positions[moved].x += 0.03;  // moves the vertex; edges are 0.1 long
  frame->positions[moved].y += 0.04;
  const ElementColours colours = colours_of(ColourBy::Displacement, frame);
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto corners = mesh.elements.corners(e);
    const bool near = std::find(corners.begin(), corners.end(), moved) != corners.end();
    EXPECT_NEAR(static_cast<double>(colours.shading->values[e]), near ? 0.5 : 0.0, 1e-6);
  }
  EXPECT_NEAR(colours.range.second, 0.5, 1e-6);
  // The element below and to the left of the vertex has grown: its area by the diagonals.
  const ElementColours sizes = colours_of(ColourBy::Size, frame);
  const Index grown = 4 * 10 + 4;
  const double exact = 0.5 * (0.13 * 0.1 + 0.1 * 0.14);  // two triangles on the diagonal to the vertex that moved
  EXPECT_NEAR(static_cast<double>(sizes.shading->values[grown]), std::log10(exact / 0.01), 1e-5);
}

TEST(Members, OfKindsGroupsValencesAndTheWorst) {
  const auto input = grouped(true);
  const Mesh& mesh = input->mesh;
  const auto frame = frame_of(input, std::vector<float>(mesh.elements.size(), 0.5F), 1);
  frame->worst = {{9, 0.1, false}, {4, 0.2, false}, {6, 0.3, false}};
  ColouringState state;
  EXPECT_EQ(members_of(state, *frame, nullptr), nullptr) << "all";
  const auto ids = [&] {
    std::vector<Index> found;
    const auto members = members_of(state, *frame, nullptr);
    for (Index e = 0; e < members->size(); ++e) {
      if ((*members)[e] != 0) found.push_back(e);
    }
    return found;
  };
  state.worst = 2;
  EXPECT_EQ(ids(), (std::vector<Index>{4, 9}));
  state.isolated = Isolation{ColourBy::Group, "core"};
  state.worst = 3;
  EXPECT_EQ(ids(), (std::vector<Index>{6})) << "both must hold";
  state.worst = 0;
  EXPECT_EQ(ids(), (std::vector<Index>{5, 6, 7}));
  state.isolated = Isolation{ColourBy::Group, "open boundary"};  // by the role of the group
  std::vector<Index> touching;
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto corners = mesh.elements.corners(e);
    if (std::any_of(corners.begin(), corners.end(), [](Index v) { return v <= 3; })) touching.push_back(e);
  }
  EXPECT_EQ(ids(), touching);
  state.isolated = Isolation{ColourBy::Kind, "quadrilateral"};
  for (const Index e : ids()) EXPECT_EQ(mesh.elements.corners(e).size(), 4U);
  EXPECT_FALSE(ids().empty());
  EXPECT_FALSE(why_unknown({ColourBy::Kind, "triangle"}, *input).has_value());
  EXPECT_TRUE(why_unknown({ColourBy::Kind, "wedge"}, *input).has_value());
  EXPECT_TRUE(why_unknown({ColourBy::Group, "nowhere"}, *input).has_value());
  EXPECT_TRUE(why_unknown({ColourBy::Valence, "many"}, *input).has_value());
  EXPECT_FALSE(why_unknown({ColourBy::Valence, "9 or more"}, *input).has_value());
}

TEST(CategoryColours, AreFarApartAndFarFromThatOfInvertedElements) {
  for (std::size_t a = 0; a < 24; ++a) {
    const render::Oklab x = render::to_oklab(category_colour(a));
    const auto far = [&](render::Rgb other) {
      const render::Oklab y = render::to_oklab(other);
      return std::hypot(x.l - y.l, x.a - y.a, x.b - y.b);
    };
    EXPECT_GT(far(render::kInvertedColour), 0.15) << a;
    for (std::size_t b = 0; b < a; ++b) EXPECT_GT(far(category_colour(b)), 0.03) << a << ' ' << b;
  }
}

class ColourWindow : public app::HeadlessTest {
 protected:
  [[nodiscard]] bool refused(std::string_view line) {
    const bool failed = window_->run(line).has_value();
    (void)window_->run("dialog none");
    return failed;
  }
  [[nodiscard]] std::array<float, 4> box(const std::string& item) { return window_->app().items().find(item); }
  void drag(std::pair<float, float> from, std::pair<float, float> to) {
    good(fmt::format("drag {} {} {} {}", from.first, from.second, to.first, to.second));
  }
  [[nodiscard]] std::pair<float, float> middle(const std::string& item) {
    const auto b = box(item);
    return {(b[0] + b[2]) / 2, (b[1] + b[3]) / 2};
  }
  [[nodiscard]] std::size_t logged(std::string_view start) {
    const auto& lines = state().commands.lines();
    return static_cast<std::size_t>(
        std::count_if(lines.begin(), lines.end(), [&](const LogLine& line) { return line.text.starts_with(start); }));
  }
};

TEST_F(ColourWindow, HandlesOfTheBarSetTheRangeAndADoubleClickResetsIt) {
  good("generate annulus");
  good("range fixed");
  const auto low = middle("range:low"), high = middle("range:high");
  const float width = high.first - low.first;
  const auto camera = state().camera;
  drag(low, {low.first + 0.25F * width, low.second});
  EXPECT_EQ(state().range_mode, RangeMode::Given);
  EXPECT_NEAR(state().range_low, 0.25, 0.006);
  EXPECT_EQ(state().range_high, 1.0);
  EXPECT_EQ(logged("range "), 2U) << "after that of before one command, at release";
  EXPECT_FALSE(state().colouring.held_range.has_value());
  drag(high, {high.first - 0.5F * width, high.second});
  EXPECT_NEAR(state().range_high, 0.625, 0.008) << "half of what the bar spans now";
  drag(middle("range:high"), {high.first + 0.5F * width, high.second});
  EXPECT_NEAR(state().range_high, 0.8125, 0.015) << "outwards, beyond the bar";
  drag(middle("range:low"), {high.first + 3 * width, low.second});
  EXPECT_LT(state().range_low, state().range_high) << "the ends never cross";
  EXPECT_EQ(state().camera, camera) << "the mesh below does not move";
  good("double-click range:bar");
  EXPECT_EQ(state().range_mode, RangeMode::Fixed);
  EXPECT_EQ(state().camera, camera);
}

TEST_F(ColourWindow, TheBarSaysItsEndsWhateverTheyAre) {
  good("generate annulus");
  good("move 5 5");
  for (const char* line : {"range 0.313 0.777", "range 0.0432 0.9876", "range auto"}) {
    good(line);
    const render::Image picture = window_->picture();
    const auto bar = window_->app().items().find("range:bar");
    // The strip below the ends, which has no round numbers, and below the handles.
    const auto inks = [&](float left) {
      std::set<std::array<int, 3>> seen;
      for (int y = static_cast<int>(bar[3]) + 6; y < static_cast<int>(bar[3]) + 13; ++y)
        for (int x = static_cast<int>(left); x < static_cast<int>(left) + 16; ++x) {
          const render::Rgba ink = picture.at(x, y);
          seen.insert({ink.r, ink.g, ink.b});
        }
      return seen.size();
    };
    EXPECT_GT(inks(bar[0]), 3U) << line;
    EXPECT_GT(inks(bar[2] - 16), 3U) << line;
  }
}

TEST_F(ColourWindow, VerbsAreCheckedAndChangeWhatTheySay) {
  EXPECT_TRUE(refused("isolate kind triangle")) << "no mesh is open";
  good("generate mixed");
  for (const char* line :
       {"color-by colour", "color-steps 1", "color-steps 65", "filter 0.5", "filter 0.5 0.5", "filter-mode dim", "worst-view 0",
        "worst-view 101", "labels some", "isolate kind", "isolate size big", "isolate kind wedge", "range 1 0"}) {
    EXPECT_TRUE(refused(line)) << line;
  }
  EXPECT_EQ(state().colouring, ColouringState{});
  good("reverse-colors");
  good("color-steps 7");
  good("filter -0.5 0.75");
  good("filter-mode only-outline");
  good("worst-view toggle");
  good("labels both");
  good("isolate kind quadrilateral");
  good("color-by valence");
  ColouringState wanted;
  wanted.reversed = true;
  wanted.steps = 7;
  wanted.filter = {-0.5, 0.75};
  wanted.others = render::Selection::Others::Outline;
  wanted.worst = 10;
  wanted.label_vertices = wanted.label_elements = true;
  wanted.isolated = Isolation{ColourBy::Kind, "quadrilateral"};
  wanted.by = ColourBy::Valence;
  EXPECT_EQ(state().colouring, wanted);
  good("labels next");
  EXPECT_FALSE(state().colouring.label_vertices || state().colouring.label_elements);
  EXPECT_TRUE(refused("color-by group") == window_->app().frame()->input->mesh.groups.empty());
}

TEST_F(ColourWindow, ACategoryOfTheLegendIsLookedAtAlone) {
  good("generate mixed");
  good("color-by kind");
  good("click \"category:triangle\"");
  EXPECT_EQ(state().colouring.isolated, (Isolation{ColourBy::Kind, "triangle"}));
  good("click \"category:triangle\"");
  EXPECT_FALSE(state().colouring.isolated.has_value());
}

TEST_F(ColourWindow, WhatIsHiddenIsNotPickedAndWhatCountsIsTheWorst) {
  good("generate annulus");
  good("worst-view 3");
  good("filter-mode isolate");
  const auto worst = window_->app().frame()->worst;
  good("fit-worst");
  const auto viewport = box("viewport");
  const auto frame = window_->app().frame();
  const auto pick_at = [&](Index element) {
    Vec2<double> centre{0, 0};
    for (const Index v : frame->input->mesh.elements.corners(element)) {
      const auto p = frame->input->geometry.plane.project(frame->positions[v]);
      centre = {centre.x + p.x / 3, centre.y + p.y / 3};
    }
    const auto pixel = state().camera.to_pixel(centre, state().viewport);
    EXPECT_GT(pixel.x, 0.0);
    EXPECT_LT(pixel.x, state().viewport.x);
    EXPECT_GT(pixel.y, 0.0);
    EXPECT_LT(pixel.y, state().viewport.y);
    good("pick none");
    good(fmt::format("click {} {}", static_cast<double>(viewport[0]) + pixel.x, static_cast<double>(viewport[1]) + pixel.y));
    return state().picked;
  };
  good(fmt::format("goto element {}", worst[0].element));
  EXPECT_EQ(pick_at(worst[0].element), (Picked{Picked::Kind::Element, worst[0].element}));
  // A neighbour that is none of the three must not be there.
  for (const Incidence& incidence : frame->input->topology.star(frame->input->mesh.elements.corners(worst[0].element)[0])) {
    const Index other = incidence.element;
    if (std::any_of(worst.begin(), worst.begin() + 3, [&](const RankedElement& one) { return one.element == other; })) continue;
    EXPECT_NE(pick_at(other), (Picked{Picked::Kind::Element, other}));
  }
}

TEST_F(ColourWindow, TheMenuUnderTheMouseCopiesInFull) {
  good("generate annulus");
  good("goto vertex 57");
  const auto viewport = box("viewport");
  const auto frame = window_->app().frame();
  const Vec3 at = frame->positions[57];
  good(fmt::format("right-click {} {}", (viewport[0] + viewport[2]) / 2, (viewport[1] + viewport[3]) / 2));
  good("click \"copy:vertex coordinates\"");
  EXPECT_EQ(window_->clipboard(), fmt::format("{} {} {}", full_number(at.x), full_number(at.y), full_number(at.z)));
  good(fmt::format("right-click {} {}", (viewport[0] + viewport[2]) / 2, (viewport[1] + viewport[3]) / 2));
  good("click \"copy:vertex quality\"");
  const double q = vertex_quality(frame->input->quality_context(), frame->input->topology, frame->positions, frame->shown, 57);
  EXPECT_EQ(window_->clipboard(), full_number(q));
}

TEST_F(ColourWindow, EveryColouringIsDrawnInEveryThemeAndInPictures) {
  open_explaining();  // one colouring shows the multipliers
  good("generate mixed");
  good("boundary slide");
  good("step iteration");
  std::map<std::string, render::Image> pictures;
  for (const ColourByInfo& one : kColourBys) {
    if (one.by == ColourBy::Tilt) continue;  // only for surfaces in space
    if (one.by == ColourBy::Group && window_->app().frame()->input->mesh.groups.empty()) continue;
    good("color-by " + std::string(one.name));
    pictures[std::string(one.name)] = window_->app().mesh_picture({});
  }
  for (const auto& [a, first] : pictures) {
    for (const auto& [b, second] : pictures) EXPECT_EQ(render::compare(first, second).alike(), a == b) << a << ' ' << b;
  }
}

}  // namespace
}  // namespace dmoscope::ui
