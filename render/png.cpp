// PNG files. The only source with stb's implementation.
#include <algorithm>
#include <climits>
#include <fstream>
#include <iterator>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#define STBI_ONLY_PNG
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>
#pragma GCC diagnostic pop

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/writing/atomic_file.h"
#include "render/image.h"

namespace dmoscope::render {

std::string encode_png(const Image& image) {
  if (image.width < 1 || image.height < 1) throw Error("an empty picture cannot be a PNG file");
  if (image.width > INT_MAX / 4) throw Error(fmt::format("a picture {} pixels wide cannot be a PNG file", image.width));
  std::string bytes;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.rgba.data(), image.width * 4) == 0 || bytes.empty()) {
    throw Error(fmt::format("a picture of {} x {} pixels cannot be compressed (not enough memory)", image.width, image.height));
  }
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) { write_file_atomically(path, encode_png(image)); }

Image read_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.is_open() || bytes.empty()) throw InputError(path.string(), 0, "cannot be read");
  if (bytes.size() > static_cast<std::size_t>(INT_MAX)) throw InputError(path.string(), 0, "too big for a picture");
  int width = 0, height = 0, channels = 0;
  stbi_uc* pixels =
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), static_cast<int>(bytes.size()), &width, &height, &channels, 4);
  if (pixels == nullptr) throw InputError(path.string(), 0, fmt::format("not a PNG picture ({})", stbi_failure_reason()));
  Image image(width, height);
  std::copy_n(pixels, image.rgba.size(), image.rgba.begin());
  stbi_image_free(pixels);
  return image;
}

}  // namespace dmoscope::render
