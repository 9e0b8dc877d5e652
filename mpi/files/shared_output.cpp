#include "mpi/files/shared_output.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace dmoscope {

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
