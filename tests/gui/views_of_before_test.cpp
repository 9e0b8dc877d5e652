// Commands of the view give the saved views, settings and scripts of an earlier version, byte for byte.
#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/engine/engine.h"
#include "ui/commands/settings.h"
#include "ui/commands/view_commands.h"
#include "ui/commands/view_json.h"

namespace dmoscope::ui {
namespace {

using Lines = std::vector<std::string>;

/// Lists values one a line, as JSON writes them: "view/panels/left true".
void list_values(const nlohmann::json& value, const std::string& name, Lines& lines) {
  if (!value.is_object()) return lines.push_back(name + ' ' + value.dump());
  for (const auto& [key, member] : value.items()) list_values(member, name + '/' + key, lines);
}

/// Everything that is written of a view; the library writes these values as JSON.
Lines written(const ViewState& state) {
  Lines lines;
  const auto view = nlohmann::json::parse(view_json(state)), settings = nlohmann::json::parse(settings_text(state));
  EXPECT_EQ(view_json(state), view.dump());
  EXPECT_EQ(settings_text(state), settings.dump(2) + '\n');
  list_values(view, "view", lines);
  list_values(settings, "settings", lines);
  for (const std::string& line : view_lines(state, true)) lines.push_back("script " + line);
  std::ranges::sort(lines);  // order does not matter: each line of a script is about something else
  return lines;
}

class ViewsOfBefore : public testing::Test {
 protected:
  ViewsOfBefore() {
    for (const auto& [mesh, command] : {std::pair{"planar", "generate grid 400"}, {"volume", "generate tetrahedra"}}) {
      Engine engine(1);
      engine.post(command);
      engine.wait_idle();
      sessions_[mesh] = engine.view();
    }
  }
  /// State of a new view after commands separated by semicolons.
  [[nodiscard]] ViewState state_after(const std::string& mesh, const std::string& commands) const {
    ViewState state;
    CommandHost host;
    host.session = [this, mesh] { return sessions_.at(mesh); };
    host.post = [](const std::string&) {};
    host.busy = [] { return false; };
    const CommandTable table = view_commands(state, host);
    state.follow(*sessions_.at(mesh));
    std::istringstream lines(commands);
    for (std::string line; std::getline(lines, line, ';');) EXPECT_NO_THROW(table.execute(line)) << line;
    return state;
  }

 private:
  std::map<std::string, std::shared_ptr<const SessionView>> sessions_;
};

/// Lines that only the second of two sorted lists has, and "no NAME" for names that only the first has.
Lines difference(const Lines& first, const Lines& second) {
  Lines lines;
  std::ranges::set_difference(second, first, std::back_inserter(lines));
  for (const std::string& line : first) {
    const std::string name = line.substr(0, line.rfind(' '));
    if (std::ranges::none_of(second, [&](const std::string& one) { return one.starts_with(name); })) lines.push_back("no " + name);
  }
  return lines;
}

/// Whether a line is about panels: they have other places and sizes since, and there are tabs, folds and the up axis.
bool is_of_panels(const std::string& line) {
  constexpr std::array<std::string_view, 19> kNew{"panel-size", "_width",          "_height",       "/layout",       "dock ",
                                                  "_side",      "script settings", "/settings ",    "script tab",    "/tab ",
                                                  "holds ",     "notice ",         "pointer_value", "plots/compare", "judged_own",
                                                  "judged-by",  "loops ",          "up_axis",       "up-axis"};
  return std::ranges::any_of(kNew, [&](std::string_view part) { return line.find(part) != std::string::npos; });
}

Lines without_panels(Lines lines) {
  std::erase_if(lines, is_of_panels);
  return lines;
}

/// Replaces old names: the left panel is now setup, the right one facts.
Lines with_names_of_then(Lines lines) {
  for (std::string& line : lines)
    for (const auto& [name, before] :
         {std::pair<std::string_view, std::string_view>{"panel setup", "panel left"}, {"panel facts", "panel right"}})
      if (const std::size_t at = line.find(name); at != std::string::npos) line.replace(at, name.size(), before);
  std::ranges::sort(lines);
  return lines;
}

TEST_F(ViewsOfBefore, AreWrittenAsTheyWere) {
  std::ifstream file(DMOSCOPE_SOURCE_DIR "/tests/data/views/views.txt");
  ASSERT_TRUE(file.is_open());
  std::map<std::string, Lines> fresh;  // values of a new view, by mesh
  std::size_t count = 0;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with('[')) continue;
    const std::string mesh = line.substr(1, line.find(']') - 1), commands = line.substr(line.find(']') + 1);
    SCOPED_TRACE(line);
    Lines expected;
    while (std::getline(file, line) && !line.empty()) expected.push_back(line);
    const Lines now = with_names_of_then(written(state_after(mesh, commands)));
    if (fresh.contains(mesh)) {
      Lines differs = difference(fresh[mesh], now);
      std::erase_if(differs, [](const std::string& one) { return one.find("tab selection") != one.npos || one.find("/tab ") != one.npos; });
      EXPECT_EQ(differs, expected);
    } else {
      EXPECT_EQ(without_panels(now), without_panels(expected));
      fresh[mesh] = now;
    }
    ++count;
  }
  EXPECT_EQ(count, 37U);
}

}  // namespace
}  // namespace dmoscope::ui
