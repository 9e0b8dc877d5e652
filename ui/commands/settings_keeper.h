#pragma once
// Writes settings and recent files as soon as they have changed, so that no end of the program loses them.

#include <filesystem>
#include <string>
#include <vector>

#include "ui/state/view_state.h"

namespace dmoscope::ui {

class SettingsKeeper {
 public:
  /// How long settings must have stood still: not every width is written through which a hand drags a panel.
  static constexpr double kStill = 0.3;

  /// Reads them. Empty paths: neither read nor written.
  void begin(std::filesystem::path settings, std::filesystem::path recent, ViewState& state);
  /// Once a frame, at `now` (seconds): writes what has changed. What could not be written is said in the log. Returns after which time it
  /// must be called again; infinity: when something changes.
  double look(ViewState& state, double now);
  /// At once what is not written yet. Returns sentences about what could not be.
  [[nodiscard]] std::vector<std::string> write(const ViewState& state);

 private:
  std::filesystem::path settings_, recent_;
  std::string written_, seen_;  // settings
  std::vector<std::string> written_recent_;
  double since_ = 0.0;
  std::string said_;
};

}  // namespace dmoscope::ui
