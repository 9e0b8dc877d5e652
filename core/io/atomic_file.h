#pragma once
// Writing a file all or nothing: into a temporary one beside it, which then takes its name.

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace dmoscope {

class GzipPacker;

/// Where a path leads when symbolic links are followed, the last one even if it dangles.
[[nodiscard]] std::filesystem::path follow_links(const std::filesystem::path& path);

/// A file being written. Until commit() the target is as it was; without commit() the temporary file is removed.
/// An existing target keeps its permissions; a symbolic link stays one, and what it points to is replaced; what is no regular file
/// (a pipe, /dev/null) is written straight.
class AtomicFile {
 public:
  /// Throws OutputError with the system's reason: a directory, a folder that is missing or may not be written.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// From now on what is written is packed by gzip on its way. Call it before the first write(), and only where gzip_is_here().
  void pack();
  /// Appends bytes. Throws OutputError (disk full).
  void write(std::string_view bytes);
  /// Makes what was written the target. Throws OutputError.
  void commit();
  /// Path as the caller gave it, for messages.
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  void write_plain(std::string_view bytes);
  void open_temporary();
  void discard() noexcept;
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  std::filesystem::path target_;     // symbolic links followed
  std::filesystem::path temporary_;  // empty: written straight, or committed
  int descriptor_ = -1;
  std::unique_ptr<GzipPacker> packer_;  // null: bytes are written as they are
};

}  // namespace dmoscope
