#include "core/engine/autosave.h"

#include <algorithm>
#include <ctime>

#include <fmt/format.h>

#include "core/io/writing/atomic_file.h"
#include "core/session/state_file.h"

namespace dmoscope {

namespace {

Recoverable about_of(const SessionStanding& session, const SafeNames& names) {
  const InputMesh& input = session.input();
  const std::string mesh = input.generator.empty() ? std::filesystem::absolute(input.path).string() : input.generator;
  return {
      names,  mesh, static_cast<std::int64_t>(std::time(nullptr)), session.runs.at(session.active).moment.iteration, session.runs.size(),
      nullptr};
}

bool anything_unsaved(const Session& session) {
  for (std::size_t i = 0; i < session.run_count(); ++i)
    if (session.would_lose(i)) return true;
  return false;
}

}  // namespace

Autosave::Autosave(AutosaveOptions options, std::function<void(const std::string&)> say)
    : options_(std::move(options)), say_(std::move(say)), place_(make_safe_place(options_.folder)), next_(Clock::now() + options_.every) {
  thread_ = std::jthread([this](const std::stop_token& stop) { write(stop); });
}

Autosave::~Autosave() {
  thread_.request_stop();
  thread_.join();
  std::error_code ignored;  // ignored: a lock without a session is of no use to anybody
  if (!std::filesystem::exists(place_.names.session, ignored)) remove_safe(place_.names);
}

void Autosave::set_view(std::string json) {
  const std::scoped_lock lock(mutex_);
  view_ = std::move(json);
}

void Autosave::supersede(const std::vector<std::filesystem::path>& recovered) {
  const std::scoped_lock lock(mutex_);
  for (const std::filesystem::path& file : recovered) {
    if (!is_safe_name(file, options_.folder)) continue;
    superseded_.push_back(file);
    next_ = Clock::now();
  }
}

Autosave::Mark Autosave::mark_of(Session& session) {
  Mark mark;
  if (!session.has_input()) return mark;
  mark.input = session.input();
  for (std::size_t i = 0; i < session.run_count(); ++i) mark.runs.push_back(session.standing(i));
  return mark;
}

/// Keeps the positions at the begin of an iteration, which may take long: within it only its begin and the visits since then can be saved.
void Autosave::note_start(Session& session, const Run& run) {
  if (!run.moment().is_iteration_end() || run.history().kept(run.moment().iteration)) return;
  const auto begin = Clock::now();
  if (begin < next_start_) return;
  for (std::size_t i = 0; i < session.run_count(); ++i)
    if (&session.run(i) == &run) starts_.note(session.identity(i));
  const auto end = Clock::now();
  next_start_ = end + std::chrono::duration_cast<Clock::duration>((end - begin) / options_.share);
}

void Autosave::while_running(Session& session, const Run& run) {
  try {
    note_start(session, run);
    if (Clock::now() >= next_) save(session, {});
  } catch (const std::bad_alloc&) {  // ignored: the run needs the memory more
  }
}

std::optional<Autosave::Clock::time_point> Autosave::due(Session& session) {
  if (!session.has_input()) return std::nullopt;
  const bool unsaved = anything_unsaved(session);
  if (!unsaved && kept_) return Clock::now();  // the file that is kept is not needed any more
  if (!unsaved || (kept_ && !failed_ && known_.is(mark_of(session)))) return std::nullopt;
  return next_;
}

void Autosave::at_rest(Session& session, bool now, const std::function<bool()>& go_on) {
  const auto when = due(session);
  if (when && (now || *when <= Clock::now())) save(session, go_on);
}

void Autosave::save(Session& session, const std::function<bool()>& go_on) {
  if (!session.has_input()) return;
  if (!anything_unsaved(session)) {
    if (kept_) hand_over({{}, {}, {}, true});
    kept_ = false;
    return;
  }
  Mark mark = mark_of(session);
  if (kept_ && !failed_ && known_.is(mark)) return;
  // Tries again a second later if that fails, as within an iteration whose begin is not known any more.
  constexpr std::chrono::milliseconds kAgain{1000};
  next_ = Clock::now() + std::min(kAgain, options_.every);
  auto standing = standing_of(session, starts_, go_on);
  if (!standing) return;
  next_ = Clock::now() + options_.every;
  known_ = std::move(mark);
  kept_ = true;
  hand_over({std::move(*standing), {}, {}, false});
}

void Autosave::hand_over(Job job) {
  {
    const std::scoped_lock lock(mutex_);
    if (ended_) return;
    job.view = view_;
    job.supersedes = std::exchange(superseded_, {});
    if (job_) job.supersedes.insert(job.supersedes.end(), job_->supersedes.begin(), job_->supersedes.end());
    job_ = std::move(job);
  }
  changed_.notify_all();
}

void Autosave::write(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  // Writes jobs, also those that were handed over before the stop.
  while (changed_.wait(lock, stop, [&] { return job_.has_value(); })) {
    Job job = std::move(*job_);
    job_.reset();
    writing_ = true;
    lock.unlock();
    carry_out(job);
    job = {};  // frees its positions, which may be the last copy
    lock.lock();
    writing_ = false;
    changed_.notify_all();
  }
}

/// Writes or removes the file. Never throws: an error is reported once, and the job is tried again when it is due.
void Autosave::carry_out(Job& job) {
  std::string trouble;
  try {
    if (job.remove) {
      std::error_code ignored;
      std::filesystem::remove(place_.names.session, ignored);
      std::filesystem::remove(place_.names.about, ignored);
    } else {
      Progress unwatched;
      write_state(place_.names.session, job.session, job.view, unwatched);
      write_file_atomically(place_.names.about, about_text(about_of(job.session, place_.names)));
    }
    for (const std::filesystem::path& file : job.supersedes) remove_safe(safe_names(file));
  } catch (const std::exception& error) {
    trouble = fmt::format("the session is not saved by itself: {}", error.what());
  }
  failed_ = !trouble.empty();
  if (trouble.empty() || trouble == said_) return;
  said_ = trouble;
  if (say_) say_(trouble);
}

bool Autosave::flush(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, patience, [&] { return !job_ && !writing_; });
}

void Autosave::end() {
  {
    std::unique_lock lock(mutex_);
    ended_ = true;
    job_.reset();
    changed_.wait(lock, [&] { return !writing_; });
  }
  remove_safe(place_.names);
}

}  // namespace dmoscope
