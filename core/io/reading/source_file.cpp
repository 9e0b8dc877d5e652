#include "core/io/reading/source_file.h"

#include <algorithm>
#include <cerrno>
#include <new>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/memory.h"
#include "core/mesh/mesh.h"

namespace dmoscope {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 22;  // bytes between two progress reports

/// An open file, closed in the destructor.
class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& path)
      : value_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK))  // does not wait for a pipe
  {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const noexcept { return value_; }

 private:
  int value_;
};

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw InputError(path.string(), 0, std::generic_category().message(error));
}

std::string_view kind_of(mode_t mode) {
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

}  // namespace

std::size_t SourceFile::line_of_row(const Mesh& mesh, std::size_t field, std::size_t row) const {
  Field::Place place = mesh.fields[field].place;
  const std::filesystem::path file = file_of_field(field);
  Progress unwatched;
  FileBytes other;
  if (file != path_) try {
      other = read_whole_file(file, unwatched);
    } catch (const InputError&) {  // ignored: the companion is missing now
      return 0;
    }
  const std::string_view text = file == path_ ? bytes() : other.view();
  Tokenizer words(text, file.string(), {.comment = '#', .free_form = true}, unwatched);
  if (place.with_positions) return layout_.binary || row >= place_count() ? 0 : words.line_at(static_cast<std::size_t>(this->place(row)));
  const auto piece = std::find_if(field_pieces_.rbegin(), field_pieces_.rend(),
                                  [&](const FieldPiece& each) { return each.field == field && each.row <= row; });
  if (piece != field_pieces_.rend()) {
    place.begin = piece->begin;
    row -= piece->row;
  }
  if (place.words == 0 || place.begin >= text.size()) return 0;
  if (!place.rows.empty()) {
    const auto found = std::ranges::find(place.rows, static_cast<Index>(row));
    if (found == place.rows.end()) return 0;
    row = static_cast<std::size_t>(found - place.rows.begin());
  }
  words.seek(place.begin);
  for (std::size_t n = row * place.words; n > 0; --n) (void)words.token();
  return words.at_end() ? 0 : words.line_at(words.offset());
}

FileBytes::FileBytes(std::string_view bytes) {
  std::ranges::copy(bytes, room(bytes.size()).begin());
  took(bytes.size());
}

std::span<char> FileBytes::room(std::size_t most) {
  if (capacity_ - size_ < most) {
    const std::size_t capacity = size_ + most;
    std::unique_ptr<char, Free> larger(static_cast<char*>(std::malloc(std::max<std::size_t>(capacity, 1))));
    if (!larger) throw std::bad_alloc();
    advise_large_pages(larger.get(), capacity);
    std::ranges::copy(view(), larger.get());
    data_ = std::move(larger);
    capacity_ = capacity;
  }
  return {data_.get() + size_, capacity_ - size_};
}

void SourceFile::add_only_in_file(std::string_view thing) {
  if (met_only_in_file_.emplace(thing).second) only_in_file_.emplace_back(thing);
}

FileBytes read_whole_file(const std::filesystem::path& path, Progress& progress, std::size_t most) {
  const Descriptor file(path);
  if (file.get() < 0) fail(path, errno);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail(path, errno);
  if (S_ISDIR(status.st_mode)) fail(path, EISDIR);
  // Refuses other kinds of files: they may be endless (/dev/zero), or block for ever.
  if (!S_ISREG(status.st_mode)) throw InputError(path.string(), 0, fmt::format("{} is no file that can be read", kind_of(status.st_mode)));
  const auto require_small = [&](std::size_t size) {
    if (size > most) throw InputError(path.string(), 0, fmt::format("too large: at most {} bytes are read of such a file", most));
  };
  require_small(static_cast<std::size_t>(std::max<off_t>(status.st_size, 0)));
  FileBytes bytes;
  // Uses the file's size as a hint: it may still grow, so reading goes on to the end.
  (void)bytes.room(static_cast<std::size_t>(std::max<off_t>(status.st_size, 0)) + 1);
  for (;;) {
    progress.check();
    std::span<char> room = bytes.room(0);
    if (room.empty()) room = bytes.room(std::max(bytes.view().size(), kChunk));
    const ssize_t got = ::read(file.get(), room.data(), std::min(kChunk, room.size()));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path, errno);
    if (got == 0) return bytes;
    bytes.took(static_cast<std::size_t>(got));
    require_small(bytes.view().size());  // files in /proc have no size
  }
}

std::string read_small_text(const std::filesystem::path& path, std::size_t most) {
  Progress unwatched;
  return std::string(read_whole_file(path, unwatched, most).view());
}

}  // namespace dmoscope
