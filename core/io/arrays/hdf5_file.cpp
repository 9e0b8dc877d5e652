#include "core/io/arrays/hdf5_file.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <new>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <hdf5.h>

#include "core/base/error.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/atomic_file.h"

namespace dmoscope {
namespace {

constexpr std::size_t kMostSizes = 8;         // greatest number of sizes of an array
constexpr std::size_t kMostText = 1U << 16U;  // bytes of an attribute
constexpr const char* kNoName = "\x01";       // a name that no link has
constexpr std::size_t kMostChildren = 1U << 20U;

/// An identifier of the library, closed in the destructor.
class H5Id {
 public:
  H5Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  H5Id(H5Id&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  H5Id(const H5Id&) = delete;
  H5Id& operator=(const H5Id&) = delete;
  H5Id& operator=(H5Id&&) = delete;
  ~H5Id() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] bool valid() const noexcept { return id_ >= 0; }
  operator hid_t() const noexcept { return id_; }  // NOLINT(google-explicit-constructor)

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// A name for a file in a folder of its own, below the system's temporary folder; the destructor removes both.
class ScratchFile {
 public:
  ScratchFile() {
    std::string name = (std::filesystem::temp_directory_path() / "dmoscope-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw OutputError(name, "no folder for temporary files can be made");
    folder_ = name;
  }
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "mesh.h5"; }

 private:
  std::filesystem::path folder_;
};

struct NumberType {
  ScalarType scalar;
  hid_t little, big;
};

/// Types of numbers that are read. H5T_... are variables that the library sets when it is initialised.
std::array<NumberType, 10> number_types() {
  return {NumberType{ScalarType::Int8, H5T_STD_I8LE, H5T_STD_I8BE},        NumberType{ScalarType::UInt8, H5T_STD_U8LE, H5T_STD_U8BE},
          NumberType{ScalarType::Int16, H5T_STD_I16LE, H5T_STD_I16BE},     NumberType{ScalarType::UInt16, H5T_STD_U16LE, H5T_STD_U16BE},
          NumberType{ScalarType::Int32, H5T_STD_I32LE, H5T_STD_I32BE},     NumberType{ScalarType::UInt32, H5T_STD_U32LE, H5T_STD_U32BE},
          NumberType{ScalarType::Int64, H5T_STD_I64LE, H5T_STD_I64BE},     NumberType{ScalarType::UInt64, H5T_STD_U64LE, H5T_STD_U64BE},
          NumberType{ScalarType::Float32, H5T_IEEE_F32LE, H5T_IEEE_F32BE}, NumberType{ScalarType::Float64, H5T_IEEE_F64LE, H5T_IEEE_F64BE}};
}

struct FileType {
  ScalarType scalar;
  bool big_endian;
};
std::optional<FileType> file_type(hid_t type) {
  for (const NumberType& one : number_types()) {
    if (H5Tequal(type, one.little) > 0) return FileType{one.scalar, false};
    if (H5Tequal(type, one.big) > 0) return FileType{one.scalar, true};
  }
  return std::nullopt;
}

/// Name for messages: "coordx" for "/coordx", since netCDF's arrays have no path.
std::string shown_name(const std::string& name) { return quote_token(name); }

herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* into) noexcept {
  auto& names = *static_cast<std::vector<std::string>*>(into);
  try {
    names.emplace_back(name);
  } catch (...) {
    return -1;
  }
  return names.size() < kMostChildren ? 0 : -1;
}

}  // namespace

/// The open file, with exclusive use of the library for this thread while it exists.
class Hdf5File::Library {
 public:
  explicit Library(std::string_view bytes) : lock_(mutex()) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // the program reports errors itself
    (void)H5Lunregister(H5L_TYPE_EXTERNAL);       // refuses other files
    (void)H5PLset_loading_state(0);               // refuses filters from elsewhere
    open(bytes);
  }
  ~Library() { (void)close(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  /// Opens a file on disk instead, for changes.
  void reopen(const std::filesystem::path& path) {
    (void)close();
    file_ = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  }
  /// Closes the file, and thereby writes all changes. False if that failed.
  [[nodiscard]] bool close() noexcept {
    const bool closed = file_ < 0 || H5Fclose(file_) >= 0;
    file_ = H5I_INVALID_HID;
    return closed;
  }
  [[nodiscard]] hid_t file() const noexcept { return file_; }

 private:
  void open(std::string_view bytes) {
    const H5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    constexpr std::size_t kGrowth = 1U << 20U;
    if (H5Pset_fapl_core(access, kGrowth, 0) < 0 || H5Pset_fclose_degree(access, H5F_CLOSE_STRONG) < 0) return;
    // The library copies the image and never writes to it.
    if (H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size()) < 0) throw std::bad_alloc();
    file_ = H5Fopen("image", H5F_ACC_RDONLY, access);
  }
  /// Mutex for the library; recursive, since several files may be open in one thread.
  static std::recursive_mutex& mutex() {
    static std::recursive_mutex one;
    return one;
  }
  std::unique_lock<std::recursive_mutex> lock_;
  hid_t file_ = H5I_INVALID_HID;
};

/// An open array.
class Hdf5File::Array {
 public:
  Array(const Hdf5File& file, const std::string& name)
      : file_(file), name_(name), id_(H5Dopen2(file.library_->file(), name.c_str(), H5P_DEFAULT), H5Dclose) {
    if (!id_.valid()) fail("it cannot be read: it is not there, no array, or damaged");
    const H5Id space(H5Dget_space(id_), H5Sclose);
    const H5Id type(H5Dget_type(id_), H5Tclose);
    const H5Id properties(H5Dget_create_plist(id_), H5Pclose);
    if (!space.valid() || !type.valid() || !properties.valid()) fail("damaged");
    layout_ = H5Pget_layout(properties);
    if (layout_ == H5D_VIRTUAL || H5Pget_external_count(properties) > 0) fail("its numbers are in another file, which is not read");
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 0 || H5Sget_simple_extent_type(space) == H5S_NULL) fail("it holds nothing");
    if (static_cast<std::size_t>(rank) > kMostSizes) fail(fmt::format("it has {} dimensions", rank));
    std::array<hsize_t, kMostSizes> sizes{};
    if (H5Sget_simple_extent_dims(space, sizes.data(), nullptr) < 0) fail("damaged");
    std::uint64_t values = 1;
    for (int d = 0; d < rank; ++d) {
      const std::uint64_t size = sizes[static_cast<std::size_t>(d)];
      if (size > 0 && values > (std::uint64_t{1} << 48U) / size) fail("damaged: it has more numbers than any file");
      values *= size;
      info.sizes.push_back(size);
    }
    read_type(type);
  }

  [[noreturn]] void fail(std::string_view what) const { file_.fail(fmt::format("array {}: {}", shown_name(name_), what)); }
  [[nodiscard]] hid_t id() const noexcept { return id_; }
  [[nodiscard]] bool is_number() const noexcept { return number_.has_value(); }
  [[nodiscard]] std::size_t text_bytes() const noexcept { return text_bytes_; }

  /// Reads the numbers with these first indices into memory of a type.
  void read(hid_t memory, std::span<const std::uint64_t> first, void* into, std::uint64_t count) const {
    herr_t result = -1;
    if (first.empty()) {
      result = H5Dread(id_, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, into);
    } else {
      std::array<hsize_t, kMostSizes> start{}, many{};
      for (std::size_t d = 0; d < info.sizes.size(); ++d) {
        start[d] = d < first.size() ? first[d] : 0;
        many[d] = d < first.size() ? 1 : info.sizes[d];
      }
      const H5Id space(H5Dget_space(id_), H5Sclose);
      const hsize_t values = count;
      const H5Id target(H5Screate_simple(1, &values, nullptr), H5Sclose);
      if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, many.data(), nullptr) < 0) fail("damaged");
      result = H5Dread(id_, memory, target, space, H5P_DEFAULT, into);
    }
    if (result < 0) fail("it cannot be unpacked: damaged, or packed by a filter that is not there");
  }

  /// Offset of the numbers in the file's bytes, if they are contiguous there.
  [[nodiscard]] std::optional<std::uint64_t> place(std::string_view bytes, std::span<const double> numbers) const {
    if (layout_ != H5D_CONTIGUOUS || !number_) return std::nullopt;
    const haddr_t offset = H5Dget_offset(id_);
    const std::size_t each = size_of(number_->scalar);
    if (offset == HADDR_UNDEF || offset > bytes.size() || numbers.size() > (bytes.size() - offset) / each) return std::nullopt;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (load_scalar(bytes.data() + offset + i * each, number_->scalar, number_->big_endian) != numbers[i]) return std::nullopt;
    }
    return offset;
  }
  [[nodiscard]] const FileType& number() const noexcept { return *number_; }

  ArrayInfo info;

 private:
  void read_type(hid_t type) {
    const H5T_class_t of = H5Tget_class(type);
    if (of == H5T_STRING && H5Tis_variable_str(type) == 0) {
      const std::size_t each = H5Tget_size(type);
      if (each == 0 || each > kMostText) fail("damaged: a text without a length");
      info.text = true;
      text_bytes_ = each;
      if (each > 1) info.sizes.push_back(each);
      return;
    }
    if (of == H5T_ARRAY) return read_letters(type);
    number_ = file_type(type);
    if (number_) info.type = number_->scalar;
    text_bytes_ = number_ && size_of(number_->scalar) == 1 ? 1 : 0;
  }

  /// Takes rows of single bytes, which MED has for texts, as text.
  void read_letters(hid_t type) {
    const H5Id letter(H5Tget_super(type), H5Tclose);
    const std::size_t each = H5Tget_size(type);
    if (!letter.valid() || H5Tget_class(letter) != H5T_INTEGER || H5Tget_size(letter) != 1 || each > kMostText) return;
    info.text = true;
    text_bytes_ = each;
    info.sizes.push_back(each);
  }

  const Hdf5File& file_;
  const std::string& name_;
  H5Id id_;
  H5D_layout_t layout_ = H5D_COMPACT;
  std::optional<FileType> number_;
  std::size_t text_bytes_ = 0;  // bytes of one piece of text; 0: no text
};

Hdf5File::Hdf5File(std::string_view bytes, std::string file, const IoContext& context)
    : ArrayFile(bytes, std::move(file)),
      library_(std::make_unique<Library>(bytes)),
      context_(context),
      left_(UnpackBudget::most(bytes.size(), context.most_memory)) {
  if (library_->file() < 0) fail("damaged: HDF5's library cannot open it");
}

Hdf5File::~Hdf5File() = default;

void Hdf5File::take_room(std::uint64_t count, std::size_t bytes_each) {
  context_.progress.check();
  if (count > left_ / bytes_each) fail(fmt::format("with {} numbers more the file unpacks to {}", count, UnpackBudget::advice()));
  left_ -= count * bytes_each;
}

std::optional<ArrayInfo> Hdf5File::find(const std::string& name) {
  const H5Id object(H5Oopen(library_->file(), name.c_str(), H5P_DEFAULT), H5Oclose);
  if (!object.valid() || H5Iget_type(object) != H5I_DATASET) return std::nullopt;
  return Array(*this, name).info;
}

std::vector<double> Hdf5File::numbers(const std::string& name, std::span<const std::uint64_t> first) {
  const Array array(*this, name);
  if (!array.is_number()) array.fail("it holds no numbers of a type that is read");
  if (first.size() > array.info.sizes.size()) array.fail("it has fewer dimensions than are asked for");
  std::uint64_t count = array.info.count();
  for (std::size_t d = 0; d < first.size(); ++d) {
    if (first[d] >= array.info.sizes[d]) array.fail("it is shorter than it should be");
    count /= array.info.sizes[d];
  }
  take_room(count, sizeof(double));
  std::vector<double> values(count);
  if (count > 0) array.read(H5T_NATIVE_DOUBLE, first, values.data(), count);
  return values;
}

std::vector<std::int64_t> Hdf5File::wholes(const std::string& name) {
  const Array array(*this, name);
  if (!array.is_number() || !is_whole(array.info.type)) array.fail("it does not hold whole numbers");
  const std::uint64_t count = array.info.count();
  take_room(count, sizeof(std::int64_t));
  std::vector<std::int64_t> values(count);
  if (count > 0) array.read(H5T_NATIVE_INT64, {}, values.data(), count);
  return values;
}

std::string Hdf5File::text(const std::string& name) {
  const Array array(*this, name);
  if (array.text_bytes() == 0) array.fail("it holds no text");
  const std::uint64_t count = array.info.count();  // counts bytes: the length of the text is the last size
  take_room(count, 1);
  std::string all(count, '\0');
  const H5Id type(H5Dget_type(array.id()), H5Tclose);
  if (count > 0) array.read(type, {}, all.data(), count);
  return all;
}

std::string Hdf5File::attribute(const std::string& array, const std::string& name) {
  const H5Id object(H5Oopen(library_->file(), array.c_str(), H5P_DEFAULT), H5Oclose);
  if (!object.valid() || H5Aexists(object, name.c_str()) <= 0) return {};
  const H5Id attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  const H5Id type(H5Aget_type(attribute), H5Tclose);
  const H5Id space(H5Aget_space(attribute), H5Sclose);
  if (!type.valid() || !space.valid() || H5Tget_class(type) != H5T_STRING) return {};
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (H5Tis_variable_str(type) > 0) {
    char* words = nullptr;
    const H5Id memory(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(memory, H5T_VARIABLE);
    H5Tset_cset(memory, H5Tget_cset(type));
    if (count != 1 || H5Aread(attribute, memory, &words) < 0 || words == nullptr) return {};
    std::string found(words);
    H5free_memory(words);
    return found;
  }
  const std::size_t each = H5Tget_size(type);
  if (count < 1 || each == 0 || each > kMostText || static_cast<std::size_t>(count) > kMostText / each) return {};
  std::string found(each * static_cast<std::size_t>(count), '\0');
  if (H5Aread(attribute, type, found.data()) < 0) return {};
  found.resize(std::min(found.find('\0'), found.size()));
  return found;
}

std::optional<std::int64_t> Hdf5File::whole_attribute(const std::string& object, const std::string& name) {
  const H5Id holder(H5Oopen(library_->file(), object.c_str(), H5P_DEFAULT), H5Oclose);
  if (!holder.valid() || H5Aexists(holder, name.c_str()) <= 0) return std::nullopt;
  const H5Id attribute(H5Aopen(holder, name.c_str(), H5P_DEFAULT), H5Aclose);
  const H5Id type(H5Aget_type(attribute), H5Tclose);
  const H5Id space(H5Aget_space(attribute), H5Sclose);
  const std::optional<FileType> number = type.valid() ? file_type(type) : std::nullopt;
  if (!number || !is_whole(number->scalar) || !space.valid() || H5Sget_simple_extent_npoints(space) != 1) return std::nullopt;
  std::int64_t value = 0;
  if (H5Aread(attribute, H5T_NATIVE_INT64, &value) < 0) return std::nullopt;
  return value;
}

std::optional<std::uint64_t> Hdf5File::dimension(const std::string& name) {
  if (attribute(name, "CLASS") != "DIMENSION_SCALE") return std::nullopt;
  const auto found = find(name);
  if (!found || found->sizes.size() != 1) return std::nullopt;
  return found->sizes.front();
}

std::vector<std::string> Hdf5File::children(const std::string& group) {
  const H5Id id(H5Gopen2(library_->file(), group.c_str(), H5P_DEFAULT), H5Gclose);
  std::vector<std::string> names;
  if (!id.valid()) return names;
  context_.progress.check();
  const H5Id properties(H5Gget_create_plist(id), H5Pclose);
  unsigned order = 0;
  const H5_index_t index =
      H5Pget_link_creation_order(properties, &order) >= 0 && (order & H5P_CRT_ORDER_INDEXED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
  // Reads in native order and sorts here: the library's own sorted table is freed uninitialised if reading it fails (1.10.8).
  H5G_info_t info{};
  const bool dense = H5Gget_info(id, &info) >= 0 && info.storage_type == H5G_STORAGE_TYPE_DENSE;
  const bool sound = H5Lexists(id, kNoName, H5P_DEFAULT) >= 0;  // whether all links of a small group can be decoded
  hsize_t at = 0;
  if (!sound || H5Literate(id, index, dense ? H5_ITER_NATIVE : H5_ITER_INC, &at, add_name, &names) < 0) {
    fail(fmt::format("group {}: damaged", shown_name(group)));
  }
  if (dense && index == H5_INDEX_NAME) std::ranges::sort(names);
  return names;
}

bool Hdf5File::opens(const std::string& name) const { return H5Id(H5Oopen(library_->file(), name.c_str(), H5P_DEFAULT), H5Oclose).valid(); }

std::string Hdf5File::replaced(std::span<const ArrayValues> arrays) {
  std::string whole(bytes());
  bool packed = false;  // whether an array is packed or in chunks
  for (const ArrayValues& values : arrays) {
    const std::vector<double> before = numbers(values.name);
    if (before.size() != values.values.size()) fail(fmt::format("array {}: it changed while it was read", shown_name(values.name)));
    const Array array(*this, values.name);
    const std::optional<std::uint64_t> place = array.place(bytes(), before);
    packed = packed || !place;
    if (!place) continue;
    const FileType& type = array.number();
    const std::size_t each = size_of(type.scalar);
    for (std::size_t v = 0; v < before.size(); ++v) {
      store_scalar(whole.data() + *place + v * each, type.scalar, type.big_endian, values.values[v]);
    }
  }
  return packed ? replaced_by_library(whole, arrays) : whole;
}

/// Replaces numbers in a file on disk: an image of a file in memory that the library returns has a wrong checksum (1.10.8, superblocks 2
/// and 3).
std::string Hdf5File::replaced_by_library(std::string_view whole, std::span<const ArrayValues> arrays) {
  const ScratchFile scratch;
  write_file_atomically(scratch.path(), whole);
  library_->reopen(scratch.path());
  if (library_->file() < 0) fail("it cannot be written again: HDF5's library opens it for reading only");
  for (const ArrayValues& values : arrays) {
    const Array array(*this, values.name);
    if (H5Dwrite(array.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.values.data()) < 0)
      array.fail("it cannot be written");
  }
  if (!library_->close()) fail("it cannot be written again by HDF5's library");
  return std::string(read_whole_file(scratch.path(), context_.progress).view());
}

}  // namespace dmoscope
