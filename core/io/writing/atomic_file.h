#pragma once
// Atomic writing of files: into a temporary one beside the target, which then takes its name.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace dmoscope {

class GzipPacker;

/// The target of a path through symbolic links, the last one even if it dangles. In a loop: some link in it.
[[nodiscard]] std::filesystem::path follow_links(const std::filesystem::path& path);

/// Whether two paths are one file, also through links and if neither exists yet. An empty path is no file.
[[nodiscard]] bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// A file being written. Until commit() the target is unchanged; without commit() the temporary file is removed. An existing target keeps
/// its permissions and, if the system allows it, its owner, group and extended attributes; a symbolic link stays one, and the file that it
/// points to is replaced; a target that is no regular file (a pipe, /dev/null) is written directly. Temporary files that killed processes
/// left in the target's folder are removed: those that no process has locked.
class AtomicFile {
 public:
  /// Begins a file. Throws OutputError with the system's reason: a directory, a loop of links, a folder that is missing or not writable.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Packs the file by gzip. To be called before the first write(), and only if gzip_is_here().
  void pack();
  /// Reserves space on the disk for a file of so many bytes, so that no later write can fail for lack of it. Throws OutputError (disk
  /// full).
  void reserve(std::uint64_t bytes);
  /// Appends bytes. Throws OutputError (disk full).
  void write(std::string_view bytes);
  /// Waits until the file is on the disk; nothing can be written afterwards. Only renaming is left that could fail. Throws OutputError.
  void finish();
  /// Makes the file the target, for good: it is on the disk before it takes the name. Throws OutputError.
  void commit();
  /// Path as the caller gave it, for messages.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// Path for others that write instead of write(), which then must not be called; empty if the target is written directly.
  [[nodiscard]] const std::filesystem::path& temporary() const noexcept { return temporary_; }
  /// A sentence for the user if replacing the target does less than expected, because it has other names (hard links). Else empty.
  [[nodiscard]] const std::string& note() const noexcept { return note_; }

 private:
  void write_plain(std::string_view bytes);
  void open_temporary();
  void discard() noexcept;
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  std::filesystem::path target_;     // target with symbolic links followed
  std::filesystem::path temporary_;  // empty: written directly, or committed
  std::string note_;
  int descriptor_ = -1;
  std::unique_ptr<GzipPacker> packer_;  // null: bytes are written unpacked
};

/// Several files that are all written before the first of them takes its name: on a full disk all of them are unchanged.
class AtomicFiles {
 public:
  /// Adds a file and writes it beside its target. Throws OutputError.
  void add(const std::filesystem::path& path, std::string_view bytes);
  /// Makes all files their targets. Throws OutputError.
  void commit();

 private:
  std::vector<std::unique_ptr<AtomicFile>> files_;
};

/// Writes bytes to a file, all or nothing. Throws OutputError.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

// Names of this program's temporary files, and removal of those that a killed process left.

/// Name of a temporary file: ".dmoscope-PID-N.tmp".
[[nodiscard]] std::string litter_name(pid_t process, unsigned number);
/// Whether a file's name is one of these.
[[nodiscard]] bool is_litter_name(std::string_view name) noexcept;

/// Removes the temporary files in a folder (empty: the current one) that no process has locked. Never fails: files that cannot be removed
/// stay.
void remove_litter(const std::filesystem::path& folder) noexcept;

}  // namespace dmoscope
