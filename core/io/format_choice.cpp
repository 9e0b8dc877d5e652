#include "core/io/format_choice.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/foreign_format.h"
#include "core/io/reading/gzip.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

const std::vector<const FormatHandler*>& handlers() {
  static const std::vector<const FormatHandler*> table{
      &off_format(),     &obj_format(),     &ply_format(),  &stl_format(),   &vtk_format(),
#ifdef DMOSCOPE_VTU
      &vtu_format(),     &vtp_format(),     &pvtu_format(), &xdmf_format(),
#endif
      &fort14_format(),  &su2_format(),     &gmsh_format(), &medit_format(), &meshb_format(),   &tetgen_format(), &abaqus_format(),
      &sms_2dm_format(), &nastran_format(), &unv_format(),  &mike_format(),  &selafin_format(), &exodus_format(),
#ifdef DMOSCOPE_HDF5
      &cgns_format(),    &med_format(),
#endif
  };
  return table;
}

}  // namespace

std::span<const FormatHandler* const> format_handlers() { return handlers(); }

std::span<const FormatInfo> format_table() {
  static const std::vector<FormatInfo> table = [] {
    std::vector<FormatInfo> result;
    for (const FormatHandler* handler : handlers()) result.push_back(handler->info);
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
  std::string_view list = handler.info.extensions;
  while (!list.empty()) {
    const std::string_view one = list.substr(0, list.find(' '));
    if (equal_ignoring_case(one, extension)) return true;
    list.remove_prefix(std::min(list.size(), one.size() + 1));
  }
  return false;
}

const FormatHandler* by_extension(std::string_view extension) {
  if (extension.size() < 2) return nullptr;
  const auto found = std::ranges::find_if(handlers(), [&](const FormatHandler* handler) { return has_extension(*handler, extension); });
  return found == handlers().end() ? nullptr : *found;
}

std::string known_formats() {
  std::string result;
  for (const FormatHandler* handler : handlers()) {
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
  for (const FormatHandler* handler : handlers()) {
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
