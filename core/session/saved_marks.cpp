#include "core/session/saved_marks.h"

#include <algorithm>

#include "core/io/writing/atomic_file.h"

namespace dmoscope {

namespace {

/// Whether a run's vertices have left their place in the input, as far as its records tell.
bool has_moved(const Run& run) {
  const Moment& at = run.moment();
  if (at.visits > 0 || run.edits().done_by(at) > 0) return true;
  const auto& records = run.history().records();
  const auto end = records.begin() + static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(at.iteration + 1, records.size()));
  return at.iteration >= records.size() ||
         std::any_of(records.begin(), end, [](const IterationRecord& record) { return record.moved > 0; });
}

}  // namespace

void SavedMarks::written(const std::filesystem::path& file) {
  std::erase_if(marks_, [&](const Mark& mark) { return mark.run.expired() || same_file(mark.file, file); });
}

void SavedMarks::add(const std::filesystem::path& file, Kind kind, const std::shared_ptr<const Run>& run) {
  std::error_code unknown;
  const std::filesystem::path whole = std::filesystem::absolute(file, unknown);
  const Moment& at = run->moment();
  marks_.push_back({unknown ? file : whole, kind, run, at, run->backend(), run->edits().all(), run->edits().done_by(at)});
}

bool SavedMarks::would_lose(const Run& run) const {
  const std::vector<Edit>& edits = run.edits().all();
  const std::size_t done = run.edits().done_by(run.moment());
  bool placed = !has_moved(run), told = done == edits.size();
  for (const Mark& mark : marks_) {
    if (mark.run.lock().get() != &run) continue;
    const bool same_path =
        mark.done == done && std::equal(edits.begin(), edits.begin() + static_cast<std::ptrdiff_t>(done), mark.edits.begin());
    placed = placed || (mark.moment == run.moment() && mark.backend == run.backend() && same_path);
    told = told || (mark.kind == Kind::Session && mark.edits == edits);
  }
  return !placed || !told;
}

}  // namespace dmoscope
