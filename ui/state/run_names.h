#pragma once
// Names of runs: when there are several, their number first, as in the list.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// A run's whole title: "2 dmo · minimum angle, grid 12"; without the number if it is the only run.
[[nodiscard]] std::string run_title(const SessionView& session, std::size_t k);

/// A run's short name, for legends and over viewports, in parts: "2", "dmo", "minimum angle, shuffle:3".
struct RunName {
  std::string number, method;  // `method`: or the name that a person gave it
  std::string aim{};           // "mean ratio"
  std::string rest{};          // differences to the other runs of its method; empty: there is none, or only the number differs
  bool one_method = true;      // all runs have this method
  bool given = false;          // named by a person
  std::string formerly{};      // whole(), as sessions and scripts saved by older versions have it
  /// Its method and aim, and the other differences to runs of its method; `given`: the name alone.
  [[nodiscard]] std::string method_and_aim() const { return given ? method : method + " · " + aim; }
  [[nodiscard]] std::string other_differences() const;
  /// whole(), without the method if all runs have the same one.
  [[nodiscard]] std::string brief() const { return one_method && !rest.empty() ? number + " " + rest : whole(); }
  [[nodiscard]] std::string whole() const { return number + " " + method + (rest.empty() ? "" : " · " + rest); }
};

/// Name of run k among all of the session: as short as differences between the runs allow.
[[nodiscard]] RunName run_name(const SessionView& session, std::size_t k);
[[nodiscard]] std::vector<RunName> run_names(const SessionView& session);

/// Remembers each run's name: a name changes when other runs come or go, and choices made by its old name must stay.
class KnownRunNames {
 public:
  /// Names that have changed since the last call, with their new ones, which are empty for runs that no longer exist.
  [[nodiscard]] std::map<std::string, std::string> follow(const SessionView& session);
  /// Present names by the names that older versions of this program gave them.
  [[nodiscard]] std::map<std::string, std::string> former() const;
  /// The run's present name if `name` is one that an older version wrote; else `name`.
  [[nodiscard]] std::string of_now(const std::string& name) const;

 private:
  struct Known {
    std::uint64_t id = 0;
    std::string title, given, name, formerly;
  };
  std::vector<Known> known_;
};

}  // namespace dmoscope::ui
