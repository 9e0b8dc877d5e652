#pragma once
// Properties of any saved session or script: it is refused with an Error, or the session is sound and can be saved and opened again.

#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/commands/session_commands.h"
#include "core/io/writing/atomic_file.h"
#include "core/session/state_file.h"
#include "tests/fuzz/memory_files.h"

namespace dmoscope::testing {

/// The mesh of all these sessions: small, and made once.
inline const std::shared_ptr<const InputMesh>& fuzz_mesh() {
  static const std::shared_ptr<const InputMesh> mesh = [] {
    Progress progress;
    return generate_input("random 40 3", progress);
  }();
  return mesh;
}

inline void check_sound_session(Session& session) {
  if (!session.has_input()) return;
  if (session.run_count() == 0 || session.active_index() >= session.run_count()) throw std::logic_error("a session without a run");
  for (std::size_t i = 0; i < session.run_count(); ++i) {
    dmoscope::Run& run = session.run(i);
    for (const Vec3 p : run.positions())
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) throw std::logic_error("a position is not finite");
    for (Index v = 0; v < run.positions().size(); ++v)
      if (run.fixed()[v] != 0 && std::memcmp(&run.positions()[v], &run.input().mesh.positions[v], sizeof(Vec3)) != 0)
        throw std::logic_error("a fixed vertex moved");
    if (run.moment().iteration >= run.history().records().size()) throw std::logic_error("no record of where the run stands");
  }
}

/// Removes the checksums of bytes that are JSON: damage that these would find first must not do harm either.
inline std::string without_checksums(const std::string& bytes) {
  auto json = nlohmann::ordered_json::parse(bytes, nullptr, false);
  if (!json.is_object()) return {};
  json["version"] = 1;
  json.erase("checksums");
  if (json.contains("runs") && json["runs"].is_array())
    for (auto& run : json["runs"])
      if (run.is_object()) run.erase("checksums");
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// Returns true if the bytes were opened. Throws std::logic_error if a property is violated.
inline bool open_bytes(const std::string& bytes, bool save_again) {
  write_file_atomically(scratch_path(), bytes);
  Session session(1);
  session.set_history_budget(0);
  Progress progress;
  try {
    (void)open_state(scratch_path(), session, progress, fuzz_mesh());
  } catch (const Error&) {
    if (session.has_input()) throw std::logic_error("half a session was opened");
    return false;
  }
  check_sound_session(session);
  if (!save_again) return true;
  try {
    save_state(scratch_path(), session, {}, progress);
  } catch (const Error&) {  // without checksums other parameters are only noticed when the run is computed again
    if (bytes.find("\"checksums\"") == std::string::npos) return true;
    throw std::logic_error("a session that was opened cannot be saved");
  }
  Progress unwatched;
  const std::string saved(read_whole_file(scratch_path(), unwatched).view());
  if (!open_bytes(saved, false)) throw std::logic_error("a session that was opened cannot be saved and opened again");
  return true;
}

inline bool check_session(const std::string& bytes) {
  const bool opened = open_bytes(bytes, true);
  const std::string bare = without_checksums(bytes);
  return (!bare.empty() && open_bytes(bare, true)) || opened;
}

/// A session to begin with: two runs, an edit, half an iteration.
inline std::string sample_session() {
  Session session(1);
  Progress progress;
  CommandContext context{session, progress, [](const Message&) {}};
  CommandTable commands;
  add_session_commands(commands, context);
  session.replace({session.make_run(fuzz_mesh(), {})}, 0, Metric::MeanRatio);
  for (const char* line : {"run 2", "visit 0-39", "step vertex 3", "add-run dvr:radius-ratio", "order shuffle:4", "fix 3", "run 1"}) {
    try {
      commands.execute(line);
    } catch (const UsageError&) {  // some of the vertices are fixed
    }
  }
  save_state(scratch_path(), session, {}, progress);
  return std::string(read_whole_file(scratch_path(), progress).view());
}

inline constexpr std::string_view kSampleScript =
    "# all kinds of verbs\nmetric radius-ratio\nrun 2\nstep vertex 3\nvisit 5-20\nback class\nseek 1 4\nadd-run dvr:mean-ratio\nrelaxation "
    "0.5\ngrid 4\nselect-run 1\nundo\nredo\nthen mean 3\nuntil-converged 2 3\ncompare methods 1\neach run 1\nexpect inverted == 0\nfix 3 "
    "4-6\norder shuffle:7\ncombine mean-ratio:0.3:density h1:0,0\nsay \"it is \\\"done\\\"\"\nremove-run 2\nhistory 0\npercentiles on\n";

/// Carries out every line, but for those that touch files, make other meshes or use other threads; long work is cancelled. Throws
/// std::logic_error if a property is violated, and all that is not an Error.
inline void check_script(std::string_view text) {
  Session session(1);
  session.set_history_budget(std::size_t{1} << 20U);
  Progress progress;
  CommandContext context{session, progress, [](const Message&) {}};
  CommandTable commands;
  add_session_commands(commands, context);
  session.replace({session.make_run(fuzz_mesh(), {})}, 0, Metric::MeanRatio);
  constexpr int kMostBlocks = 200, kMostLines = 40;
  int lines = 0;
  while (!text.empty() && lines++ < kMostLines) {
    const std::string line(text.substr(0, text.find('\n')));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    int blocks = 0;
    session.observe([&](const dmoscope::Run&) {
      if (++blocks > kMostBlocks) progress.request_cancel();
    });
    progress.clear_cancel();
    try {
      const std::vector<std::string> words = split_words(line);
      const std::string verb = words.empty() ? std::string() : words[0];
      const bool touches_files = verb == "open" || verb == "reload" || verb == "export" || verb.ends_with("-state") || verb == "stats" ||
                                 verb == "elements" || verb == "generate" || verb == "threads";
      if (touches_files || session.run_count() > 20) continue;
      commands.execute(line);
    } catch (const Error&) {
    }
    check_sound_session(session);
  }
}

}  // namespace dmoscope::testing
