// The man page of a program with a window lists all of the window's commands.
#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "ui/commands/view_commands.h"

namespace dmoscope::ui {
namespace {

std::string man_page() {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen("\"" DMOSCOPE_PROGRAM "\" --man", "r"), pclose);
  std::string text;
  std::array<char, 4096> block{};
  while (pipe && std::fgets(block.data(), block.size(), pipe.get()) != nullptr) text += block.data();
  return text;
}

TEST(ManPage, ListsTheVerbsOfTheWindow) {
  const std::string page = man_page();
  ASSERT_TRUE(page.starts_with(".TH DMOSCOPE"));
  for (const CommandInfo& verb : view_command_infos()) {
    std::string roff;
    for (const char c : verb.usage) roff += c == '-' ? std::string("\\-") : std::string(1, c);
    EXPECT_NE(page.find("\\fB" + roff + "\\fR"), std::string::npos) << verb.usage;
  }
}

}  // namespace
}  // namespace dmoscope::ui
