#include "mpi/files/shared_mesh_file.h"

#include <array>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/io/mesh_io.h"

namespace dmoscope {

namespace {

struct Opener {
  std::string_view format;
  std::unique_ptr<SharedMeshFile> (*open)(const World&, const std::filesystem::path&);
};
constexpr std::array<Opener, 5> kOpeners{{{"vtu", open_shared_vtu},
                                          {"pvtu", open_shared_pvtu},
                                          {"obj", open_shared_obj},
                                          {"off", open_shared_off},
                                          {"fort14", open_shared_fort14}}};

const Opener& opener_of(const std::filesystem::path& path) {
  const FormatInfo* format = format_by_extension(path.extension().string());
  for (const Opener& one : kOpeners)
    if (format != nullptr && format->name == one.format) return one;
  throw UsageError(fmt::format(
      "{}: several ranks read and write .vtu, .pvtu, .obj, .off, .14 and .grd; dmoscope convert makes one of others", path.string()));
}

}  // namespace

std::unique_ptr<SharedMeshFile> open_shared(const World& world, const std::filesystem::path& path) {
  return opener_of(path).open(world, path);
}

void require_same_kind(const std::filesystem::path& input, const std::filesystem::path& output) {
  if (opener_of(input).format == opener_of(output).format) return;
  throw UsageError(fmt::format("{}: several ranks write the format that they have read, {}; dmoscope convert makes another of it",
                               output.string(), input.extension().string()));
}

SharedOutput::SharedOutput(const World& world, const std::filesystem::path& target, std::uint64_t size) : world_(world), target_(target) {
  std::string temporary;
  world.together([&] {
    if (!world.is_first()) return;
    file_ = std::make_unique<AtomicFile>(target);
    temporary = file_->temporary().string();
    if (temporary.empty()) throw OutputError(target.string(), "this is no file whose parts can be written");
    file_->reserve(size);
    file_->finish();  // the bytes that reserve room must not reach a shared disk after the others' parts
  });
  world.broadcast(temporary, 0);
  world.together([&] {
    descriptor_ = ::open(temporary.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
  });
}

SharedOutput::~SharedOutput() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void SharedOutput::write(std::uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
}

std::vector<std::string> SharedOutput::commit() {
  world_.together([&] {
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != ENOSYS && errno != EROFS) fail(errno);
  });
  world_.together([&] {
    if (file_) file_->commit();
  });
  if (!file_ || file_->note().empty()) return {};
  return {target_.filename().string() + ": " + file_->note()};
}

void SharedOutput::fail(int error) const { throw OutputError(target_.string(), std::generic_category().message(error)); }

}  // namespace dmoscope
