#pragma once
// A session that is driven by lines, without a thread of its own.

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/commands/session_commands.h"

namespace dmoscope::testing {

class SpokenSession : public ::testing::Test {
 protected:
  explicit SpokenSession(Acceleration acceleration = {}) : session_(2, std::move(acceleration)) {
    add_session_commands(commands_, context_);
  }
  void say(const std::string& line) { commands_.execute(line); }
  [[nodiscard]] bool fails(const std::string& line) {
    try {
      say(line);
    } catch (const Error&) {
      return true;
    }
    return false;
  }
  /// The error message of the command; empty: it succeeds.
  [[nodiscard]] std::string why(const std::string& line) {
    try {
      say(line);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }

  Session session_;
  Progress progress_;
  std::vector<std::string> messages_;
  CommandContext context_{session_, progress_, [this](const Message& message) { messages_.push_back(message.text); }, {}};
  CommandTable commands_;
};

}  // namespace dmoscope::testing
