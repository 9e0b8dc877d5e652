#pragma once
// Packing and unpacking by zlib, which is not in every build: files packed by gzip (RFC 1952) such as mesh.vtk.gz, blocks (RFC 1950).

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"

namespace dmoscope {

/// Whether zlib is in this build.
[[nodiscard]] bool gzip_is_here() noexcept;
[[nodiscard]] bool is_gzip(std::string_view bytes) noexcept;

/// The unpacked bytes; `path`: name in errors. Some kilobytes may unpack to gigabytes: more than an UnpackBudget with context.most_memory
/// allows is refused. Throws InputError (damaged, truncated, too large, no zlib), Cancelled.
[[nodiscard]] FileBytes gunzipped(const std::filesystem::path& path, std::string_view packed, const IoContext& context);

/// Packs bytes in a stream. Equal bytes give equal files: they contain no name and no time.
class GzipPacker {
 public:
  using Sink = std::function<void(std::string_view packed)>;
  /// Begins a stream; to be called only if gzip_is_here().
  explicit GzipPacker(Sink sink);
  ~GzipPacker();
  GzipPacker(const GzipPacker&) = delete;
  GzipPacker& operator=(const GzipPacker&) = delete;
  void add(std::string_view bytes);
  /// Ends the stream; to be called once.
  void finish();

 private:
  struct Stream;
  void run(std::string_view bytes, bool last);
  std::unique_ptr<Stream> stream_;
  Sink sink_;
};

// --- Blocks of known size; only in builds with zlib ---

/// Appends the `size` bytes that `packed` unpacks to. False, with `out` unchanged, if it unpacks to any other size; allocates nothing for
/// sizes that so few bytes cannot unpack to.
[[nodiscard]] bool zlib_unpack(std::string_view packed, std::size_t size, std::vector<char>& out);

[[nodiscard]] std::string zlib_packed(std::string_view bytes);

}  // namespace dmoscope
