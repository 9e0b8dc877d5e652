#pragma once
// Reading and writing meshes as byte strings, for tests and fuzzers.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

#include "core/io/format.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/patch_writer.h"

namespace dmoscope::testing {

/// The handler of a format by its name ("vtk").
inline const FormatHandler& handler_of(std::string_view format) {
  for (const FormatHandler* handler : format_handlers()) {
    if (handler->info.name == format) return *handler;
  }
  throw std::logic_error("no such format");
}

/// Separator of the two files of a format that has two.
inline constexpr char kBetweenFiles = '\x1e';

/// Reads bytes as a format. Throws InputError.
inline Mesh read_bytes(std::string_view format, std::string_view bytes) {
  Progress progress;
  const std::size_t end = handler_of(format).companion == nullptr ? bytes.size() : std::min(bytes.find(kBetweenFiles), bytes.size());
  auto source = std::make_shared<SourceFile>("sample." + std::string(format), FileBytes(bytes.substr(0, end)));
  source->set_format(handler_of(format).info.name);
  if (handler_of(format).companion != nullptr) {
    const std::string_view rest = bytes.substr(std::min(end + 1, bytes.size()));
    source->set_companion(std::make_shared<SourceFile>("companion." + std::string(format), FileBytes(rest)));
  }
  Mesh mesh = handler_of(format).read(*source, progress);
  mesh.source = std::move(source);
  return mesh;
}

struct Written {
  std::string bytes;
  Notes notes;
};

/// Path of a file of this process alone, removed at the end of the program.
inline const std::filesystem::path& scratch_path() {
  struct Scratch {
    // In memory if there is such a folder, so that no write waits for a disk.
    std::filesystem::path path = (std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : std::filesystem::temp_directory_path()) /
                                 std::filesystem::path("dmoscope-test-" + std::to_string(::getpid()));
    Scratch() = default;
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
      std::error_code ignored;
      std::filesystem::remove(path, ignored);
    }
  };
  static const Scratch scratch;
  return scratch.path;
}

template <class Write>
Written written_by(Write&& write) {
  Progress progress;
  Written result;
  {
    AtomicFile file(scratch_path());
    result.notes = write(file, progress);
    file.commit();
  }
  result.bytes = read_whole_file(scratch_path(), progress).view();
  return result;
}

/// Writes a new file of a format. Throws OutputError.
inline Written write_anew(std::string_view format, const Mesh& mesh, std::span<const Vec3> positions) {
  const FormatHandler& handler = handler_of(format);
  Written result = written_by([&](AtomicFile& file, Progress& progress) {
    if (handler.write == nullptr) throw OutputError(file.path().string(), std::string(handler.not_written));
    return handler.write(file, mesh, positions, progress);
  });
  if (handler.companion == nullptr) return result;
  const Written second = written_by([&](AtomicFile& file, Progress& progress) {
    handler.companion->write(file, mesh, progress);
    return Notes();
  });
  result.bytes += kBetweenFiles + second.bytes;
  return result;
}

/// All bytes that a mesh was read from, in the form of read_bytes().
inline std::string source_bytes(const SourceFile& source) {
  std::string bytes(source.bytes());
  if (source.companion() != nullptr) bytes.append(1, kBetweenFiles).append(source.companion()->bytes());
  return bytes;
}

/// Writes the mesh's own file with moved coordinates. Throws OutputError.
inline Written write_again(const Mesh& mesh, std::span<const Vec3> positions) {
  const FormatHandler& handler = handler_of(mesh.source->format());
  Written result = written_by([&](AtomicFile& file, Progress& progress) {
    return (handler.patch != nullptr ? handler.patch : write_patched)(file, mesh, positions, progress);
  });
  if (mesh.source->companion() != nullptr) result.bytes.append(1, kBetweenFiles).append(mesh.source->companion()->bytes());
  return result;
}

}  // namespace dmoscope::testing
