#pragma once
// The session's verbs: what the window's buttons, a script and the tests all say.
//
//   open FILE | reload | generate KIND [SIZE [SEED]] | export FILE | stats FILE.csv | elements FILE.csv
//   save-state FILE [VIEW-JSON] | open-state FILE
//   metric NAME | show NAME | method NAME | grid N | levels N | omega X | precision float|double | backend auto|cpu|cuda
//   relaxation X | directions random|axes | seed N
//   combine FIRST:THRESHOLD:SECOND [SIZE] | combine off | size-point X Y | then mean [PATIENCE] | then nothing
//   order natural|shuffle:SEED | interfaces fixed|free | fix WORD... (see vertices_named) | unfix
//   step vertex|class|iteration [COUNT] | back vertex|class|iteration [COUNT]
//   run ITERATIONS | until-converged [PATIENCE [MAX]] | visit VERTEX|A-B... | seek ITERATION [VISITS [EDITS]] | reset
//   add-run METHOD[:METRIC] | select-run K | remove-run K | undo | redo | threads N | history MIB | max-memory SIZE|off | percentiles
//   on|off expect minimum|movable|mean|inverted|iteration|moved  <|<=|==|>=|>  VALUE say TEXT each step|run|back|until-converged|seek|reset
//   [N [MAX]] | compare methods|metrics [ITERATIONS] | compare orders N [ITERATIONS]

#include <functional>
#include <vector>

#include "core/base/progress.h"
#include "core/session/commands.h"
#include "core/session/message.h"
#include "core/session/session.h"

namespace dmoscope {

/// What a session verb works on.
struct CommandContext {
  Session& session;
  Progress& progress;
  std::function<void(Message)> say;
  std::vector<std::string> done{};  // commands for what the one at work has done besides moving runs; see CommandEnd::again
};

/// The verbs in the order of the list above, for help, palette and man page.
[[nodiscard]] const std::vector<CommandInfo>& session_commands();

/// "natural" or "shuffle:SEED". Throws UsageError.
[[nodiscard]] VisitOrder parse_order(std::string_view word);

/// "float" or "double". Throws UsageError.
[[nodiscard]] Precision parse_precision(std::string_view word);

/// Adds them to `table`; their handlers keep a reference to `context`, which must outlive the table.
void add_session_commands(CommandTable& table, CommandContext& context);

}  // namespace dmoscope
