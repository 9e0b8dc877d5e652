#pragma once
// What runs are called where there is little room: in legends and over viewports.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// A run's name in its parts, in the order in which they are read: "2", "dmo", "min-angle, shuffle:3".
struct RunName {
  std::string number, method;
  std::string rest{};      // what tells it from the other runs by its method; empty: there is none, or nothing does but the number
  bool one_method = true;  // all runs have this method
  [[nodiscard]] std::string whole() const { return number + " " + method + (rest.empty() ? "" : " " + rest); }
};

/// The name of run k among all of the session: as short as they can be told apart by what they do.
[[nodiscard]] RunName run_name(const SessionView& session, std::size_t k);
[[nodiscard]] std::vector<RunName> run_names(const SessionView& session);

/// Remembers which run has which name: a name changes with the other runs there are, and what was said of a run by its old name holds on.
class KnownRunNames {
 public:
  /// The names that have changed since the last call, with the ones that they are now; those of runs that are no more with nothing.
  [[nodiscard]] std::map<std::string, std::string> follow(const SessionView& session);

 private:
  struct Known {
    std::uint64_t id = 0;
    std::string title, name;
  };
  std::vector<Known> known_;
};

}  // namespace dmoscope::ui
