#pragma once
// Writes settings and recent files as soon as they have changed, so that no end of the program loses them.

#include <filesystem>
#include <string>
#include <vector>

#include "ui/state/view_state.h"

namespace dmoscope::ui {

class SettingsKeeper {
 public:
  /// Seconds for which settings must be unchanged before they are written, so that not every width of a dragged panel is.
  static constexpr double kStill = 0.3;

  /// Reads both files. Empty paths: neither read nor written.
  void begin(std::filesystem::path settings, std::filesystem::path recent, ViewState& state);
  /// Writes changes; to be called once a frame, at `now` (seconds). Failures are messages in the log. Returns the seconds after which it
  /// must be called again; infinity: when something changes.
  double look(ViewState& state, double now);
  /// Writes everything that is not yet written. Returns sentences about failures.
  [[nodiscard]] std::vector<std::string> write(const ViewState& state);

 private:
  std::filesystem::path settings_, recent_;
  std::string written_, seen_;  // texts of the settings
  std::vector<std::string> written_recent_;
  double since_ = 0.0;
  std::string said_;
};

}  // namespace dmoscope::ui
