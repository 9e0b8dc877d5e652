#pragma once
// What runs are called: wherever there are several, their number first, as in the list.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// "2 dmo · minimum angle, grid 12": the run's whole title; without the number where it is the only run.
[[nodiscard]] std::string run_title(const SessionView& session, std::size_t k);

/// A run's name where there is little room, as in legends and over viewports, in its parts: "2", "dmo", "minimum angle, shuffle:3".
struct RunName {
  std::string number, method;  // `method`: or what a person called it
  std::string rest{};          // what tells it from the other runs by its method; empty: there is none, or nothing does but the number
  bool one_method = true;      // all runs have this method
  bool given = false;          // by a person
  std::string formerly{};      // whole(), as saved sessions and scripts of before have it
  [[nodiscard]] std::string whole() const { return number + " " + method + (rest.empty() ? "" : " · " + rest); }
};

/// The name of run k among all of the session: as short as they can be told apart by what they do.
[[nodiscard]] RunName run_name(const SessionView& session, std::size_t k);
[[nodiscard]] std::vector<RunName> run_names(const SessionView& session);

/// Remembers which run has which name: a name changes with the other runs there are, and what was said of a run by its old name holds on.
class KnownRunNames {
 public:
  /// The names that have changed since the last call, with the ones that they are now; those of runs that are no more with nothing.
  [[nodiscard]] std::map<std::string, std::string> follow(const SessionView& session);
  /// How older versions of this program wrote the names there are now.
  [[nodiscard]] std::map<std::string, std::string> former() const;
  /// The run's name of now where `name` is one that an older version wrote; else `name`.
  [[nodiscard]] std::string of_now(const std::string& name) const;

 private:
  struct Known {
    std::uint64_t id = 0;
    std::string title, given, name, formerly;
  };
  std::vector<Known> known_;
};

}  // namespace dmoscope::ui
