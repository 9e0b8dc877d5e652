#include "core/io/reading/gzip.h"

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/reading/io_context.h"

#ifdef DMOSCOPE_VTU  // zlib is available in such builds
#include <zlib.h>
#endif

namespace dmoscope {

bool is_gzip(std::string_view bytes) noexcept { return bytes.starts_with("\x1f\x8b\x08"); }

#ifdef DMOSCOPE_VTU
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;
constexpr int kGzip = 16 + MAX_WBITS;  // zlib's code for "with gzip's head and foot"

/// Calls inflate() repeatedly, since a file may consist of several that were joined.
class Unpacker {
 public:
  explicit Unpacker(std::string_view packed) : rest_(packed) {
    if (inflateInit2(&stream_, kGzip) != Z_OK) throw std::bad_alloc();
  }
  ~Unpacker() { inflateEnd(&stream_); }
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  enum class Step : std::uint8_t { More, Done, Truncated, Damaged };
  /// Fills a part of `room`, `got` bytes.
  Step step(std::span<char> room, std::size_t& got) {
    constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest_.data()));  // zlib does not write to its input
    stream_.avail_in = static_cast<uInt>(std::min(rest_.size(), kMost));
    stream_.next_out = reinterpret_cast<Bytef*>(room.data());
    stream_.avail_out = static_cast<uInt>(std::min(room.size(), kMost));
    const std::size_t offered = stream_.avail_in, free = stream_.avail_out;
    const int result = inflate(&stream_, Z_NO_FLUSH);
    rest_.remove_prefix(offered - stream_.avail_in);
    got = free - stream_.avail_out;
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result == Z_STREAM_END) {
      if (!is_gzip(rest_)) return Step::Done;  // ignores what follows, such as zeros
      inflateReset(&stream_);
      return Step::More;
    }
    if (result == Z_BUF_ERROR || (result == Z_OK && rest_.empty() && got == 0)) return Step::Truncated;
    return result == Z_OK ? Step::More : Step::Damaged;
  }

 private:
  z_stream stream_{};
  std::string_view rest_;
};

}  // namespace

bool gzip_is_here() noexcept { return true; }

FileBytes gunzipped(const std::filesystem::path& path, std::string_view packed, const IoContext& context) {
  UnpackBudget budget(packed.size(), context.most_memory);
  const auto fail = [&](const std::string& what) { throw InputError(path.string(), 0, what); };
  Unpacker unpacker(packed);
  FileBytes bytes;
  for (;;) {
    context.progress.check();
    std::span<char> room = bytes.room(0);
    if (room.empty()) room = bytes.room(std::max(bytes.view().size(), kPiece));
    std::size_t got = 0;
    const Unpacker::Step step = unpacker.step(room, got);
    bytes.took(got);
    if (!budget.take(got)) fail(fmt::format("packed by gzip, its {} bytes unpack to {}", packed.size(), UnpackBudget::advice()));
    if (step == Unpacker::Step::Done) return bytes;
    if (step == Unpacker::Step::Truncated) fail("packed by gzip, but truncated");
    if (step == Unpacker::Step::Damaged) fail("packed by gzip, but damaged");
  }
}

struct GzipPacker::Stream {
  z_stream z{};
};

GzipPacker::GzipPacker(Sink sink) : stream_(std::make_unique<Stream>()), sink_(std::move(sink)) {
  constexpr int kMemory = 8;  // default of zlib
  if (deflateInit2(&stream_->z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
}

GzipPacker::~GzipPacker() { deflateEnd(&stream_->z); }

void GzipPacker::add(std::string_view bytes) {
  for (; bytes.size() > kPiece; bytes.remove_prefix(kPiece)) run(bytes.substr(0, kPiece), false);
  run(bytes, false);
}

void GzipPacker::finish() { run({}, true); }

void GzipPacker::run(std::string_view bytes, bool last) {
  z_stream& z = stream_->z;
  std::array<char, 65536> out;
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib does not write to its input
  z.avail_in = static_cast<uInt>(bytes.size());
  do {
    z.next_out = reinterpret_cast<Bytef*>(out.data());
    z.avail_out = static_cast<uInt>(out.size());
    (void)deflate(&z, last ? Z_FINISH : Z_NO_FLUSH);  // fails only for wrong arguments
    sink_({out.data(), out.size() - z.avail_out});
  } while (z.avail_out == 0);
}

bool zlib_unpack(std::string_view packed, std::size_t size, std::vector<char>& out) {
  constexpr std::size_t kMostPerByte = 1032;  // best ratio of deflate
  if (size / kMostPerByte > packed.size()) return false;
  const std::size_t before = out.size();
  out.resize(before + size);
  uLongf unpacked = size;
  auto packed_size = static_cast<uLong>(packed.size());
  const int result =
      uncompress2(reinterpret_cast<Bytef*>(out.data() + before), &unpacked, reinterpret_cast<const Bytef*>(packed.data()), &packed_size);
  if (result == Z_OK && unpacked == size && packed_size == packed.size()) return true;
  out.resize(before);
  if (result == Z_MEM_ERROR) throw std::bad_alloc();
  return false;
}

std::string zlib_packed(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  const int result = compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                               static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION);
  if (result != Z_OK) throw std::bad_alloc();  // the only remaining reason, given the bound
  packed.resize(size);
  return packed;
}

#else

bool gzip_is_here() noexcept { return false; }

FileBytes gunzipped(const std::filesystem::path& path, std::string_view, const IoContext&) {
  throw InputError(path.string(), 0, "packed by gzip, which this build of the program, made without zlib, cannot read: unpack it first");
}

struct GzipPacker::Stream {};
GzipPacker::GzipPacker(Sink sink) : sink_(std::move(sink)) {}
GzipPacker::~GzipPacker() = default;
void GzipPacker::add(std::string_view bytes) { sink_(bytes); }
void GzipPacker::finish() {}
void GzipPacker::run(std::string_view, bool) {}

#endif

}  // namespace dmoscope
