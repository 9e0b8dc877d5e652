// The command language, and the engine that runs it on a thread of its own.

#include "core/engine/engine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "core/session/csv.h"
#include "core/view/frame_builder.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

std::vector<Message> messages_of(Engine& engine, const std::string& line) {
  engine.post(line);
  engine.wait_idle();
  return engine.take_messages();
}
bool fails(const std::vector<Message>& messages, int exit_code, const std::string& part) {
  for (const Message& message : messages)
    if (message.kind == Message::Kind::Error && message.exit_code == exit_code && message.text.find(part) != std::string::npos) return true;
  return false;
}
bool errors(const std::vector<Message>& messages) {
  for (const Message& message : messages)
    if (message.kind == Message::Kind::Error) return true;
  return false;
}

TEST(Words, SplitAndQuoteAreInverse) {
  for (const std::string& word :
       {std::string("plain"), std::string("two words"), std::string("a\"b\\c"), std::string(""), std::string("#x")})
    EXPECT_EQ(split_words("verb " + quote_word(word) + " # rest").at(1), word);
  EXPECT_TRUE(split_words("  # only a comment").empty());
  EXPECT_THROW((void)split_words("open \"half"), UsageError);
}

TEST(Engine, StepsSwitchesMetricAndKeepsTheOldRun) {
  Engine engine(2);
  EXPECT_EQ(engine.view()->input, nullptr);
  EXPECT_TRUE(fails(messages_of(engine, "step iteration"), 2, "no mesh is open"));
  EXPECT_FALSE(errors(messages_of(engine, "generate quads 400")));
  const auto start = engine.view();
  ASSERT_NE(start->frame, nullptr);
  EXPECT_FALSE(errors(messages_of(engine, "step iteration 3")));
  const auto stepped = engine.view();
  EXPECT_EQ(stepped->runs[0].moment.iteration, 3U);
  EXPECT_EQ(stepped->runs[0].records.size(), 4U);
  EXPECT_GT(stepped->frame->statistics.minimum, start->frame->statistics.minimum);
  EXPECT_GT(stepped->frame->serial, start->frame->serial);
  EXPECT_EQ(stepped->frame->input_serial, start->frame->input_serial);

  EXPECT_FALSE(errors(messages_of(engine, "show scaled-jacobian")));
  EXPECT_EQ(engine.view()->frame->shown, Metric::ScaledJacobian);
  EXPECT_EQ(engine.view()->runs.size(), 1U) << "showing another metric changes no run";
  EXPECT_FALSE(errors(messages_of(engine, "metric scaled-jacobian")));
  const auto switched = engine.view();
  EXPECT_EQ(switched->runs.size(), 2U) << "a run that has moved is kept beside the new one";
  EXPECT_EQ(switched->active, 1U);
  EXPECT_EQ(switched->frame->moment, Moment{});
  EXPECT_FALSE(errors(messages_of(engine, "select-run 1")));
  EXPECT_EQ(engine.view()->frame->moment.iteration, 3U);
  EXPECT_FALSE(errors(messages_of(engine, "metric mean-ratio")));
}

TEST(Engine, ParametersOfAnUntouchedRunChangeInPlace) {
  Engine engine(1);
  messages_of(engine, "generate random 100");
  for (const char* line : {"grid 9", "levels 4", "omega 0.6", "precision double", "order shuffle:3", "metric radius-ratio"})
    EXPECT_FALSE(errors(messages_of(engine, line))) << line;
  const auto view = engine.view();
  ASSERT_EQ(view->runs.size(), 1U);
  const RunParameters& parameters = view->runs[0].parameters;
  EXPECT_EQ(parameters.search, (SearchParameters{9, 4, 0.6, Precision::Double, {}}));
  EXPECT_EQ(parameters.order, VisitOrder{3});
  EXPECT_EQ(parameters.metric, Metric::RadiusRatio);
}

TEST(Engine, ErrorsCarryExitCodesAndLeaveTheSessionAlone) {
  Engine engine(1);
  messages_of(engine, "generate random 100");
  const auto before = engine.view()->frame;
  EXPECT_TRUE(fails(messages_of(engine, "open /nonexistent/mesh.off"), 3, "/nonexistent/mesh.off"));
  EXPECT_TRUE(fails(messages_of(engine, "step sideways"), 2, "usage: step vertex|class|iteration [COUNT]"));
  EXPECT_TRUE(fails(messages_of(engine, "grid 1000"), 2, "2 to 64"));
  EXPECT_TRUE(fails(messages_of(engine, "nonsense"), 2, "unknown command"));
  EXPECT_TRUE(fails(messages_of(engine, "expect minimum > 2"), 1, "expected minimum > 2"));
  EXPECT_FALSE(errors(messages_of(engine, "expect inverted == 0")));
  EXPECT_TRUE(fails(messages_of(engine, "remove-run 1"), 2, "last run"));
  EXPECT_EQ(engine.view()->frame->input, before->input);
}

TEST(Engine, EveryVerbIsDocumentedAndKnown) {
  CommandTable table;
  Session session(1);
  Progress progress;
  CommandContext context{session, progress, [](const Message&) {}};
  add_session_commands(table, context);
  for (const CommandInfo& info : session_commands()) {
    EXPECT_TRUE(table.knows(info.name));
    EXPECT_EQ(info.usage.substr(0, info.name.size()), info.name);
    EXPECT_FALSE(info.doc.empty());
  }
}

TEST(Engine, CancelStopsLongWorkQuicklyAndDropsTheQueue) {
  Engine engine(2);
  messages_of(engine, "generate grid 40000");
  engine.post("run 100000");
  engine.post("metric nonsense");
  while (engine.view()->runs.empty() || engine.view()->runs[0].moment == Moment{})
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  engine.cancel();
  engine.wait_idle();
  bool cancelled = false;
  for (const Message& message : engine.take_messages()) {
    cancelled = cancelled || message.text.find("cancelled") != std::string::npos;
    EXPECT_EQ(message.text.find("nonsense"), std::string::npos);
  }
  EXPECT_TRUE(cancelled);
  EXPECT_LT(engine.view()->runs[0].moment.iteration, 100000U);
  EXPECT_FALSE(errors(messages_of(engine, "step class"))) << "the run goes on from where it stands";
}

TEST(Engine, ExportWritesWhatIsShownAndStatsAreATable) {
  const auto folder = std::filesystem::temp_directory_path() / "dmoscope_test_engine";
  std::filesystem::create_directories(folder);
  Engine engine(1);
  messages_of(engine, "generate annulus 500");
  messages_of(engine, "run 2");
  const auto view = engine.view();
  EXPECT_FALSE(errors(messages_of(engine, "export " + quote_word((folder / "a b.off").string()))));
  EXPECT_FALSE(errors(messages_of(engine, "stats " + quote_word((folder / "s.csv").string()))));
  EXPECT_FALSE(errors(messages_of(engine, "open " + quote_word((folder / "a b.off").string()))));
  EXPECT_EQ(engine.view()->frame->positions, view->frame->positions) << "exact doubles through a text file";
  std::ifstream stream(folder / "s.csv");
  std::string line;
  std::getline(stream, line);
  EXPECT_EQ(line, "run,iteration,min_quality,mean_quality,inverted,moved,seconds,movable_minimum");
  int rows = 0;
  while (std::getline(stream, line)) ++rows;
  EXPECT_EQ(rows, 3);
  std::filesystem::remove_all(folder);
}

TEST(Frame, WorstListAndHistogramAgreeWithSorting) {
  std::vector<double> qualities;
  for (int i = 0; i < 1000; ++i) qualities.push_back(std::fmod(i * 0.618033988749895, 1.2) - 0.1);
  qualities[17] = std::nan("");
  const auto worst = worst_elements(qualities, 10);
  ASSERT_EQ(worst.size(), 10U);
  std::vector<double> sorted;
  for (const double q : qualities)
    if (!std::isnan(q)) sorted.push_back(q);
  std::ranges::sort(sorted);
  for (std::size_t i = 0; i < worst.size(); ++i) EXPECT_EQ(worst[i].quality, sorted[i]);
  const Histogram histogram = make_histogram(qualities);
  Index total = histogram.below + histogram.above;
  for (const Index count : histogram.counts) total += count;
  EXPECT_EQ(total, 999U);
  EXPECT_EQ(histogram.below, static_cast<Index>(std::ranges::count_if(sorted, [](double q) { return q < 0; })));
}

TEST(Frame, ShowsOfEveryElementWhatPlainFunctionsFind) {
  Session session(2);
  Progress progress;
  session.open(testing::lattice(200, 0.8, 7, testing::Cells::Mixed), progress);  // 60,000 elements: several stretches for the threads
  session.active().step(StepUnit::Class, progress);
  session.show(Metric::ScaledJacobian);
  FrameBuilder builder;
  const auto frame = builder.build(session)->frame;
  const QualityContext context = frame->input->quality_context();
  std::vector<double> now, before;
  for (Index e = 0; e < frame->input->mesh.elements.size(); ++e) {
    now.push_back(element_quality(context, frame->positions, Metric::ScaledJacobian, e));
    before.push_back(element_quality(context, frame->input->mesh.positions, Metric::ScaledJacobian, e));
    ASSERT_EQ(frame->quality[e], static_cast<float>(now[e])) << e;
    ASSERT_EQ(frame->inverted[e] != 0, smallest_jacobian(context, frame->positions, e) <= 0.0) << e;
  }
  EXPECT_EQ(frame->now.counts, make_histogram(now).counts);
  EXPECT_EQ(frame->now.below, make_histogram(now).below);
  EXPECT_EQ(frame->before.counts, make_histogram(before).counts);
  EXPECT_EQ(frame->before.below, make_histogram(before).below);
  EXPECT_NE(frame->now.counts, frame->before.counts);
  const auto worst = worst_elements(now, 100);
  ASSERT_EQ(frame->worst.size(), 100U);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(frame->worst[i].element, worst[i].element);
    EXPECT_EQ(frame->worst[i].quality, worst[i].quality);
  }
  const auto fixed = session.active().fixed();
  for (const auto& [shown, metric] :
       {std::pair{frame->shown_statistics, Metric::ScaledJacobian}, std::pair{frame->statistics, Metric::MeanRatio}}) {
    const Statistics plain = compute_statistics(context, frame->positions, metric, fixed, nullptr);
    EXPECT_EQ(shown.minimum, plain.minimum);
    EXPECT_EQ(shown.movable_minimum, plain.movable_minimum);
    EXPECT_EQ(shown.ceiling, plain.ceiling);
    EXPECT_EQ(shown.worst_element, plain.worst_element);
    EXPECT_EQ(shown.inverted, plain.inverted);
    EXPECT_NEAR(shown.mean, plain.mean, 1e-14);
  }
}

}  // namespace
}  // namespace dmoscope
