#pragma once
// Where a window's session is saved by itself, and what windows that came to no good end have left there.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dmoscope {

/// Held as long as it lives, by this process alone, and let go by the system when the process ends, however it ends.
class FileLock {
 public:
  /// Null where somebody else holds it, or the file cannot be locked. `create`: makes the file, which must be new.
  [[nodiscard]] static std::unique_ptr<FileLock> take(const std::filesystem::path& file, bool create);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

/// The three files of one window: its session, what is told of it, and the lock that tells whether the window still lives.
struct SafeNames {
  std::filesystem::path session, about, lock;
};
/// "window-PID-N" with their endings. `stem` may be any of the three.
[[nodiscard]] SafeNames safe_names(const std::filesystem::path& stem);
/// Whether a file is one that a window saved by itself in this folder, and not a person's own.
[[nodiscard]] bool is_safe_name(const std::filesystem::path& file, const std::filesystem::path& folder);
/// Removes them; what is not there is no failure.
void remove_safe(const SafeNames& names) noexcept;

/// A session that a window left behind.
struct Recoverable {
  SafeNames names;
  std::string mesh;             // path of its file, or the words that made it
  std::int64_t when = 0;        // seconds since 1970
  std::uint64_t iteration = 0;  // of the active run
  std::size_t runs = 1;
  std::shared_ptr<const FileLock> lock;  // so that no other window offers it, too
};

/// What is written into SafeNames::about.
[[nodiscard]] std::string about_text(const Recoverable& what);

/// Newest first. What a dead window left that is no session is removed.
[[nodiscard]] std::vector<Recoverable> find_recoverable(const std::filesystem::path& folder);

/// Makes names that no other window has, and the folder where it is missing; the lock is held. Throws OutputError.
struct SafePlace {
  SafeNames names;
  std::shared_ptr<const FileLock> lock;
};
[[nodiscard]] SafePlace make_safe_place(const std::filesystem::path& folder);

}  // namespace dmoscope
