#include "core/engine/engine.h"

#include <algorithm>
#include <future>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/returned_memory.h"
#include "core/engine/give_way.h"

namespace dmoscope {

std::chrono::steady_clock::duration publication_pause(bool light, std::chrono::steady_clock::duration cost) {
  constexpr std::chrono::milliseconds kWhole{100}, kLight{12};
  constexpr int kShare = 5;
  return std::max<std::chrono::steady_clock::duration>(light ? kLight : kWhole, kShare * cost);
}

Engine::Engine(unsigned threads, Acceleration acceleration, Backend backend)
    : session_(threads, std::move(acceleration), backend),
      context_{session_, progress_, [this](Message message) { say(std::move(message)); }},
      view_(std::make_shared<SessionView>()) {
  return_large_memory();
  add_session_commands(commands_, context_);
  thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

Engine::~Engine() {
  cancel();
  {
    const std::scoped_lock lock(mutex_);
    queue_.clear();
  }
  thread_.request_stop();
}

void Engine::set_report_writer(ReportWriter writer) {
  if (!writer) return;
  context_.report = [this, write = std::move(writer)](const std::filesystem::path& file) { write(session_, file, progress_); };
}

std::uint64_t Engine::post(std::string command_line) {
  std::uint64_t id = 0;
  {
    const std::scoped_lock lock(mutex_);
    id = ++last_id_;
    queue_.push_back({id, std::move(command_line)});
  }
  changed_.notify_all();
  return id;
}

std::size_t Engine::pending() const {
  const std::scoped_lock lock(mutex_);
  return queue_.size() + (working_ ? 1 : 0);
}

void Engine::watch(std::vector<Watch> watched) {
  {
    const std::scoped_lock lock(mutex_);
    if (watched_ == watched) return;
    watched_ = std::move(watched);
    watch_new_ = true;
  }
  changed_.notify_all();
}

std::vector<Watch> Engine::watched() const {
  const std::scoped_lock lock(mutex_);
  return watched_;
}

void Engine::wait_idle() {
  std::unique_lock lock(mutex_);
  ++waiting_;
  changed_.notify_all();
  changed_.wait(lock, [&] { return queue_.empty() && !watch_new_ && !working_ && !resting_; });
  --waiting_;
}

void Engine::cancel() {
  {
    const std::scoped_lock lock(mutex_);
    std::deque<Posted> looks;
    for (auto look = next_look(); look != queue_.end(); look = next_look()) {
      looks.push_back(std::move(*look));
      queue_.erase(look);
    }
    for (const Posted& command : queue_) ends_.push_back({command.id, CommandEnd::Kind::Dropped});
    queue_ = std::move(looks);
    if (working_) progress_.request_cancel();
  }
  changed_.notify_all();
}

std::string Engine::current_command() const {
  const std::scoped_lock lock(mutex_);
  return !working_ && !queue_.empty() ? queue_.front().line : current_.line;
}

std::shared_ptr<const SessionView> Engine::view() {
  const std::scoped_lock lock(mutex_);
  taken_ = true;
  return view_;
}

std::vector<Message> Engine::take_messages() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(messages_, {});
}

std::vector<CommandEnd> Engine::take_ends() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(ends_, {});
}

void Engine::autosave(AutosaveOptions options) {
  auto made = std::make_unique<Autosave>(std::move(options), [this](const std::string& trouble) {
    say({Message::Kind::Warning, trouble, 0});
  });
  const std::scoped_lock lock(mutex_);
  autosave_ = std::move(made);
}

void Engine::set_autosaved_view(std::string json) {
  if (autosave_) autosave_->set_view(std::move(json));
}

bool Engine::autosave_now(std::chrono::milliseconds patience) {
  if (!autosave_) return true;
  const auto until = std::chrono::steady_clock::now() + patience;
  {
    std::unique_lock lock(mutex_);
    safe_wanted_ = true;
    changed_.notify_all();
    if (!changed_.wait_until(lock, until, [&] { return !safe_wanted_; })) return false;
  }
  return autosave_->flush(std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now()));
}

void Engine::end_autosave() {
  if (autosave_) autosave_->end();
}

void Engine::set_wake(std::function<void()> wake) {
  const std::scoped_lock lock(mutex_);
  wake_ = std::move(wake);
}

void Engine::work(const std::stop_token& stop) {
  constexpr std::chrono::milliseconds kQuiet{60};
  std::unique_lock lock(mutex_);
  while (wait_for_work(lock, stop)) {
    resting_ = true;  // also while a view for new watches is made
    if (queue_.empty()) {
      lock.unlock();
      publish_at_rest();
    } else {
      work_off(lock);
    }
    lock.lock();
    // Waits for a quiet moment: dragging along the timeline asks for the next state at once, and must not wait for other work.
    changed_.wait_for(lock, stop, kQuiet, [&] { return !queue_.empty() || watch_new_ || waiting_ > 0 || safe_wanted_; });
    lock.unlock();
    rest(stop);
    lock.lock();
    resting_ = false;
    changed_.notify_all();
  }
}

/// Waits until there is something to do, autosaving meanwhile; false: the engine ends.
bool Engine::wait_for_work(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  const auto wanted = [&] { return !queue_.empty() || watch_new_ || safe_wanted_; };
  while (!stop.stop_requested()) {
    const auto due = autosave_ ? autosave_->due(session_) : std::nullopt;
    const bool woken = due ? changed_.wait_until(lock, stop, *due, wanted) : changed_.wait(lock, stop, wanted);
    if (safe_wanted_) {
      autosave_at_rest(lock, stop, true);
      safe_wanted_ = false;
      changed_.notify_all();
    } else if (woken) {
      return true;
    } else if (due && !stop.stop_requested()) {
      autosave_at_rest(lock, stop, false);
    }
  }
  return false;
}

/// Autosaves while nothing else is done. `lock` is held before and after. Never throws: a failure is tried again.
void Engine::autosave_at_rest(std::unique_lock<std::mutex>& lock, const std::stop_token& stop, bool now) {
  lock.unlock();
  const auto go_on = [&] {
    const std::scoped_lock asking(mutex_);
    return !stop.stop_requested() && (now || (queue_.empty() && !watch_new_ && !safe_wanted_));
  };
  try {
    if (autosave_) autosave_->at_rest(session_, now, go_on);
  } catch (const std::exception&) {  // such as a failing device, which the next command reports
  }
  lock.lock();
}

/// Carries out the first command of the queue; `lock` is held before and not after.
void Engine::work_off(std::unique_lock<std::mutex>& lock) {
  current_ = std::move(queue_.front());
  queue_.pop_front();
  working_ = true;
  looks_pass_ = reach_of(current_.line) == CommandReach::Paths;
  progress_.clear_cancel();
  lock.unlock();
  if (looks_pass_ && give_way_.exchange(false)) dmoscope::give_way(*session_.pool());
  const CommandEnd end = run_one(current_);
  publish_at_rest();
  lock.lock();
  working_ = looks_pass_ = false;
  current_ = {};
  ends_.push_back(end);
  changed_.notify_all();
  const auto wake = wake_;
  lock.unlock();
  if (wake) wake();  // idle now: time for the last look at progress
}

CommandEnd Engine::run_one(const Posted& command) {
  const auto moment = [this] { return session_.has_input() ? session_.active().moment() : Moment{}; };
  progress_.begin(command.line);
  context_.done.clear();
  session_.observe([this](const Run& run) {
    try {
      carry_out_looks();
      publish_if_due();
      if (autosave_) autosave_->while_running(session_, run);
    } catch (const DeviceError&) {
      if (&run == &session_.active()) throw;  // failure of another run's device: reported when that run is used next
    }
  });
  const Moment before = moment();
  const SessionPoint point = session_.point();
  CommandEnd end{command.id, execute(command.line)};
  safeguard();
  end.at = moment();
  end.moved = end.at != before;
  if (end.kind != CommandEnd::Kind::Done) end.again = commands_from(session_, point, context_.done);
  return end;
}

/// Autosaves the result of a command if it is due, unless that would take long.
void Engine::safeguard() {
  const auto recovered = std::exchange(context_.recovered, {});
  if (!autosave_) return;
  try {
    autosave_->supersede(recovered);
    autosave_->at_rest(session_, false, {});
  } catch (const std::exception&) {  // such as a failing device, which the next command reports
  }
}

CommandEnd::Kind Engine::execute(const std::string& line) {
  using Kind = CommandEnd::Kind;
  try {
    commands_.execute(line);
    return Kind::Done;
  } catch (const Cancelled& cancelled) {
    say({Message::Kind::Warning, "cancelled: " + line, cancelled.exit_code()});
    return Kind::Cancelled;
  } catch (const Error& error) {
    say({Message::Kind::Error, error.what(), error.exit_code()});
  } catch (const std::bad_alloc&) {
    say({Message::Kind::Error, "not enough memory for: " + line, 3});
  } catch (const std::exception& unforeseen) {  // the user's session must survive errors of the program
    say({Message::Kind::Error, line + ": " + unforeseen.what(), 3});
  }
  return Kind::Failed;
}

/// The first command of the queue that may be carried out during the one at work; none behind one that may change anything. Called with
/// `mutex_` held.
/// `mutex_` is held.
std::deque<Engine::Posted>::iterator Engine::next_look() {
  if (working_ && !looks_pass_) return queue_.end();
  for (auto command = queue_.begin(); command != queue_.end(); ++command) {
    const CommandReach reach = reach_of(command->line);
    if (reach == CommandReach::Look) return command;
    if (reach == CommandReach::Session) break;
  }
  return queue_.end();
}

/// Carries out commands that change only what is shown, during the one at work, and publishes their results at once.
void Engine::carry_out_looks() {
  bool any = false;
  for (;;) {
    Posted look;
    {
      const std::scoped_lock lock(mutex_);
      const auto next = next_look();
      if (next == queue_.end()) break;
      look = std::move(*next);
      queue_.erase(next);
    }
    CommandEnd end{look.id, execute(look.line)};
    end.at = session_.active().moment();
    any = true;
    const std::scoped_lock lock(mutex_);
    ends_.push_back(std::move(end));
  }
  if (!any) return;
  publish(FrameDetail::Quick);
  next_publication_ = std::chrono::steady_clock::now();  // publishes a complete frame as soon as this one is taken
}

void Engine::publish_if_due() {
  bool asked_for = false;  // whether there are new watches
  {
    const std::scoped_lock lock(mutex_);
    asked_for = watch_new_;
  }
  if (!asked_for && (!taken_ || std::chrono::steady_clock::now() < next_publication_)) return;
  publish(FrameDetail::Live);
}

/// Publishes a view of the session at rest. Never throws: an error is reported, and the last view stays.
void Engine::publish_at_rest() {
  try {
    try {
      publish(FrameDetail::Whole);
    } catch (const DeviceError&) {  // the run goes on from the state on the host
      session_.active().recover();
      say({Message::Kind::Warning, session_.active().take_warning(), 0});
      publish(FrameDetail::Whole);
    }
  } catch (const Error& error) {
    say({Message::Kind::Error, fmt::format("what is reached cannot be shown: {}", error.what()), error.exit_code()});
  } catch (const std::bad_alloc&) {
    say({Message::Kind::Error, "not enough memory to show what is reached", 3});
  }
}

/// Computes what views show besides frames, until the next command. Never throws.
void Engine::rest(const std::stop_token& stop) {
  const auto go_on = [&] {
    const std::scoped_lock lock(mutex_);
    return !stop.stop_requested() && queue_.empty() && !watch_new_ && !safe_wanted_;
  };
  try {
    if (frames_.work_at_rest(session_, watched(), go_on)) publish(FrameDetail::Whole);
    if (long_work_ && frames_.work_long_at_rest(session_, go_on)) publish(FrameDetail::Whole);
    if (long_work_ && go_on() && try_at_rest(go_on)) publish(FrameDetail::Whole);
  } catch (const Error& error) {
    say({Message::Kind::Warning, error.what(), 0});
  } catch (const std::bad_alloc&) {
    say({Message::Kind::Warning, "not enough memory to compare the runs", 0});
  }
}

/// Runs trials that nobody asked for, on a thread of lower priority, and waits for it.
bool Engine::try_at_rest(const std::function<bool()>& go_on) {
  const auto attempt = [&] {
    ThreadPool alone(1);
    dmoscope::give_way(alone);
    return frames_.try_at_rest(session_, go_on);
  };
  return std::async(std::launch::async, attempt).get();
}

void Engine::publish(FrameDetail detail) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Watch> watched;
  {
    const std::scoped_lock lock(mutex_);
    watched = watched_;
    watch_new_ = false;
  }
  auto view = frames_.build(session_, detail, watched);
  const auto end = std::chrono::steady_clock::now();
  const bool light = view->frame && view->frame->device;
  next_publication_ = end + publication_pause(light, end - start);
  std::function<void()> wake;
  {
    const std::scoped_lock lock(mutex_);
    view_ = std::move(view);
    taken_ = false;
    wake = wake_;
  }
  if (wake) wake();
}

void Engine::say(Message message) {
  std::function<void()> wake;
  {
    const std::scoped_lock lock(mutex_);
    messages_.push_back(std::move(message));
    wake = wake_;
  }
  if (wake) wake();
}

}  // namespace dmoscope
