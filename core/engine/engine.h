#pragma once
// A session on a thread of its own. Whoever drives it (window, script, test) posts command lines and reads views; nobody else
// touches the session, so nothing that takes long can block the window.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/base/progress.h"
#include "core/commands/session_commands.h"
#include "core/engine/autosave.h"
#include "core/engine/command_end.h"
#include "core/view/frame_builder.h"
#include "core/view/view.h"

namespace dmoscope {

/// How long a worker that took `cost` to publish goes on before it publishes again: so long that publishing takes at most a sixth of its
/// time, and that a screen can show all there is (60 a second of light frames, 10 of whole ones).
[[nodiscard]] std::chrono::steady_clock::duration publication_pause(bool light, std::chrono::steady_clock::duration cost);

class Engine {
 public:
  /// See Session.
  explicit Engine(unsigned threads = 0, Acceleration acceleration = {}, Backend backend = Backend::Auto);
  /// Cancels what runs, drops what waits, joins.
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Queues one command line of the table in commands.h. Returns at once the command's number (1, 2, ...); whatever goes wrong becomes a
  /// Message. One that changes only what is shown (CommandReach::Look) passes those that only change paths, also the one at work: it is
  /// carried out, and a view with it published, after the block of visits under way. Where it
  /// is another metric, its statistics and the like follow with the next view (Frame::provisional).
  std::uint64_t post(std::string command_line);
  /// Commands posted and not yet finished, the one at work included.
  [[nodiscard]] std::size_t pending() const;
  [[nodiscard]] bool busy() const { return pending() != 0; }
  /// What views show besides the active run from now on: see SessionView::watched. Returns at once; a new view follows.
  void watch(std::vector<Watch> watched);
  /// Blocks until nothing is pending and all is worked out that is while the session rests (for scripts and tests; the window never calls
  /// it).
  void wait_idle();
  /// Cancels the command at work and drops the waiting ones, but for those that would have passed them (see post).
  void cancel();
  [[nodiscard]] const Progress& progress() const noexcept { return progress_; }
  /// What runs now, as typed; empty when idle.
  [[nodiscard]] std::string current_command() const;

  /// From the next command that smooths on whatever computes gives way to the program's other threads, see give_way(ThreadPool&): for a
  /// window.
  void give_way() { give_way_ = true; }
  /// From now on what takes long is not worked out while the session rests, such as what holds the minimum: views show it where it was
  /// asked for.
  void rest_without_long_work() { long_work_ = false; }

  /// Sets the function behind `save-report`, which runs on the engine's thread: core writes no pages. To be called before the first post.
  using ReportWriter = std::function<void(Session&, const std::filesystem::path&, Progress&)>;
  void set_report_writer(ReportWriter writer);

  /// From now on the session is saved by itself; see Autosave. Before the first post. Throws OutputError.
  void autosave(AutosaveOptions options);
  /// What goes along with it: see save_state. Without autosave() it is of no use.
  void set_autosaved_view(std::string json);
  [[nodiscard]] bool autosaves() const noexcept { return autosave_ != nullptr; }
  /// Saves by itself at once, what there is to save, as soon as no command is at work, and waits for that; false: not within `patience`.
  bool autosave_now(std::chrono::milliseconds patience);
  /// A good end: what was saved by itself is removed.
  void end_autosave();

  /// The latest state; never null. While a command goes on new frames are published (of a run on a device light ones, see Frame), each
  /// publication_pause() after the one before and only once that was taken by view(); at its end a whole one.
  [[nodiscard]] std::shared_ptr<const SessionView> view();
  /// Messages since the last call, oldest first.
  [[nodiscard]] std::vector<Message> take_messages();
  /// How the commands ended that did since the last call, in the order in which they did.
  [[nodiscard]] std::vector<CommandEnd> take_ends();
  /// Called from the worker whenever a view or message is new (the window wakes its event loop with it). Set before the first post.
  void set_wake(std::function<void()> wake);

 private:
  void work(const std::stop_token& stop);
  void work_off(std::unique_lock<std::mutex>& lock);
  struct Posted {
    std::uint64_t id = 0;
    std::string line;
  };
  [[nodiscard]] CommandEnd run_one(const Posted& command);
  [[nodiscard]] CommandEnd::Kind execute(const std::string& line);
  void safeguard();
  [[nodiscard]] std::deque<Posted>::iterator next_look();
  void carry_out_looks();
  void publish(FrameDetail detail);
  void publish_if_due();
  void publish_at_rest();
  void rest(const std::stop_token& stop);
  [[nodiscard]] bool try_at_rest(const std::function<bool()>& go_on);
  [[nodiscard]] bool wait_for_work(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  void autosave_at_rest(std::unique_lock<std::mutex>& lock, const std::stop_token& stop, bool now);
  [[nodiscard]] std::vector<Watch> watched() const;
  void say(Message message);

  Progress progress_;
  Session session_;  // touched by the worker alone
  CommandContext context_;
  CommandTable commands_;
  std::function<void()> wake_;

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Posted> queue_;
  Posted current_;
  std::uint64_t last_id_ = 0;
  std::vector<CommandEnd> ends_;
  std::vector<Watch> watched_;
  bool watch_new_ = false;  // there is no view with them yet
  bool working_ = false;
  bool safe_wanted_ = false;  // somebody waits in autosave_now()
  bool looks_pass_ = false;   // the command at work only changes paths
  bool resting_ = false;      // works out what nobody waits for
  int waiting_ = 0;           // in wait_idle()
  std::vector<Message> messages_;
  std::shared_ptr<const SessionView> view_;
  std::atomic<bool> taken_{true};
  std::atomic<bool> give_way_{false}, long_work_{true};
  FrameBuilder frames_;
  std::chrono::steady_clock::time_point next_publication_;
  std::unique_ptr<Autosave> autosave_;  // null: nothing is saved by itself
  std::jthread thread_;                 // last: everything above exists before it starts
};

}  // namespace dmoscope
