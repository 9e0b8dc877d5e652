#pragma once
// Files that were packed by gzip (RFC 1952): mesh.vtk.gz. Needs zlib, which is not in every build.

#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>

#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"

namespace dmoscope {

/// Is zlib in this build?
[[nodiscard]] bool gzip_is_here() noexcept;
[[nodiscard]] bool is_gzip(std::string_view bytes) noexcept;

/// What the bytes unpack to; `path` is what errors call them. Some kilobytes may unpack to gigabytes: what is more than an UnpackBudget
/// with context.most_memory has is refused. Throws InputError (damaged, truncated, too large, no zlib), Cancelled.
[[nodiscard]] FileBytes gunzipped(const std::filesystem::path& path, std::string_view packed, const IoContext& context);

/// Packs bytes as they come. The same bytes give the same file: no name and no time are in it.
class GzipPacker {
 public:
  using Sink = std::function<void(std::string_view packed)>;
  /// Call it only where gzip_is_here().
  explicit GzipPacker(Sink sink);
  ~GzipPacker();
  GzipPacker(const GzipPacker&) = delete;
  GzipPacker& operator=(const GzipPacker&) = delete;
  void add(std::string_view bytes);
  /// Call it once, at the end.
  void finish();

 private:
  struct Stream;
  void run(std::string_view bytes, bool last);
  std::unique_ptr<Stream> stream_;
  Sink sink_;
};

}  // namespace dmoscope
