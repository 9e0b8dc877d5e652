#pragma once
// Writing a file all or nothing: into a temporary one beside it, which then takes its name.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dmoscope {

class GzipPacker;

/// Where a path leads when symbolic links are followed, the last one even if it dangles. Of a loop: some link in it.
[[nodiscard]] std::filesystem::path follow_links(const std::filesystem::path& path);

/// Whether two paths are one file, also through links and when neither exists yet. An empty path is no file.
[[nodiscard]] bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// A file being written. Until commit() the target is as it was; without commit() the temporary file is removed.
/// An existing target keeps its permissions and, where the system allows it, its owner, group and extended attributes; a symbolic link
/// stays one, and what it points to is replaced; a target that is no regular file (a pipe, /dev/null) is written directly. Temporary files
/// that killed processes left in the target's folder are removed: those that no process has locked.
class AtomicFile {
 public:
  /// Throws OutputError with the system's reason: a directory, a loop of links, a folder that is missing or may not be written.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// From now on what is written is packed by gzip on its way. Call it before the first write(), and only where gzip_is_here().
  void pack();
  /// Makes room on the disk for a file of so many bytes, so that no later write can fail for want of it. Throws OutputError (disk full).
  void reserve(std::uint64_t bytes);
  /// Appends bytes. Throws OutputError (disk full).
  void write(std::string_view bytes);
  /// Waits until what was written is on the disk; nothing can be written afterwards. Then only renaming is left that could fail.
  /// Throws OutputError.
  void finish();
  /// Makes what was written the target, for good: it is on the disk before it takes the name. Throws OutputError.
  void commit();
  /// Path as the caller gave it, for messages.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// Where others may write besides write(), which then must not be called; empty where the target is written directly.
  [[nodiscard]] const std::filesystem::path& temporary() const noexcept { return temporary_; }
  /// A sentence for a person where replacing the target does less than it seems: it has other names (hard links). Else empty.
  [[nodiscard]] const std::string& note() const noexcept { return note_; }

 private:
  void write_plain(std::string_view bytes);
  void open_temporary();
  void discard() noexcept;
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  std::filesystem::path target_;     // symbolic links followed
  std::filesystem::path temporary_;  // empty: written straight, or committed
  std::string note_;
  int descriptor_ = -1;
  std::unique_ptr<GzipPacker> packer_;  // null: bytes are written as they are
};

/// Several files that are written before the first of them takes its name: on a full disk all of them are as they were.
class AtomicFiles {
 public:
  /// Throws OutputError.
  void add(const std::filesystem::path& path, std::string_view bytes);
  /// Makes them what was written. Throws OutputError.
  void commit();

 private:
  std::vector<std::unique_ptr<AtomicFile>> files_;
};

/// Writes bytes beside `path` and renames: all or nothing. Throws OutputError.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace dmoscope
