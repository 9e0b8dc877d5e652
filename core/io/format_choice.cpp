#include "core/io/format_choice.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/reading/gzip.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

constexpr auto kHandlers = std::to_array<const FormatHandler*>({
    &kOffFormat,    &kObjFormat,     &kPlyFormat,  &kStlFormat,   &kVtkFormat,
#ifdef DMOSCOPE_VTU
    &kVtuFormat,    &kVtpFormat,     &kPvtuFormat, &kXdmfFormat,
#endif
    &kFort14Format, &kSu2Format,     &kGmshFormat, &kMeditFormat, &kMeshbFormat,   &kTetgenFormat, &kAbaqusFormat,
    &kSms2dmFormat, &kNastranFormat, &kUnvFormat,  &kMikeFormat,  &kSelafinFormat, &kExodusFormat,
#ifdef DMOSCOPE_HDF5
    &kCgnsFormat,   &kMedFormat,
#endif
});

}  // namespace

std::span<const FormatHandler* const> format_handlers() { return kHandlers; }

std::span<const FormatInfo> format_table() {
  static const std::vector<FormatInfo> table = [] {
    std::vector<FormatInfo> result;
    for (const FormatHandler* handler : kHandlers) result.push_back(handler->info);
    return result;
  }();
  return table;
}

const FormatInfo* format_by_extension(std::string_view extension) {
  const FormatHandler* handler = by_extension(extension);
  return handler == nullptr ? nullptr : &handler->info;
}

std::string mesh_extension(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return gzip_is_here() && equal_ignoring_case(extension, kPacked) ? path.stem().extension().string() : extension;
}

bool has_extension(const FormatHandler& handler, std::string_view extension) {
  return any_word(handler.info.extensions, [&](std::string_view one) { return equal_ignoring_case(one, extension); });
}

const FormatHandler* by_extension(std::string_view extension) {
  if (extension.size() < 2) return nullptr;
  const auto found = std::ranges::find_if(kHandlers, [&](const FormatHandler* handler) { return has_extension(*handler, extension); });
  return found == kHandlers.end() ? nullptr : *found;
}

std::string known_formats() {
  std::string result;
  for (const FormatHandler* handler : kHandlers) {
    result += fmt::format("{}{} ({})", result.empty() ? "" : ", ", handler->info.name, handler->info.extensions);
  }
#ifndef DMOSCOPE_VTU
  result += "; VTU and XDMF are left out of this build of the program, which was made without zlib or pugixml";
#endif
#ifndef DMOSCOPE_HDF5
  result += "; CGNS and MED, and Exodus and XDMF in HDF5, are left out of this build of the program, which was made without HDF5";
#endif
  return result;
}

bool is_certain(const FormatHandler& handler, std::string_view bytes) { return handler.recognises != nullptr && handler.recognises(bytes); }

FileBytes read_unpacked(const std::filesystem::path& path, const IoContext& context, std::size_t& size) {
  FileBytes bytes = read_whole_file(path, context.progress);
  size = bytes.view().size();
  return is_gzip(bytes.view()) ? gunzipped(path, bytes.view(), context) : std::move(bytes);
}

const FormatHandler& format_of(const std::filesystem::path& path, std::string_view bytes) {
  const std::string extension = mesh_extension(path);
  const FormatHandler* named = by_extension(extension);
  if (named != nullptr && is_certain(*named, bytes)) return *named;
  for (const FormatHandler* handler : kHandlers) {
    if (is_certain(*handler, bytes)) return *handler;
  }
  if (named != nullptr) return *named;
  const std::string foreign = foreign_format(bytes, extension);
  throw InputError(path.string(), 0, foreign.empty() ? "unknown format; known are " + known_formats() : foreign);
}

std::filesystem::path main_path(const std::filesystem::path& path, const FormatHandler* handler) {
  if (handler == nullptr || handler->companion == nullptr) return path;
  if (!equal_ignoring_case(path.extension().string(), handler->companion->extension)) return path;
  return std::filesystem::path(path).replace_extension(handler->companion->main_extension);
}

std::filesystem::path companion_path(const std::filesystem::path& main, const CompanionFile& companion) {
  return std::filesystem::path(main).replace_extension(companion.extension);
}

}  // namespace dmoscope
