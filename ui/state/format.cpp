#include "ui/state/format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace dmoscope::ui {
namespace {

/// The last `count` folders of a path.
std::string folders_of(const std::filesystem::path& file, std::size_t count) {
  std::filesystem::path folders;
  std::filesystem::path at = file.parent_path();
  for (std::size_t k = 0; k < count && at.has_filename(); ++k, at = at.parent_path())
    folders = folders.empty() ? at.filename() : at.filename() / folders;
  return at.has_filename() ? folders.string() : (at / folders).string();
}

}  // namespace

std::string short_number(double value) {
  if (!std::isfinite(value)) return "–";
  return four_digits(value);
}

std::string degrees(double angle) { return angle < 1.0 ? fmt::format("{:.2g}°", angle) : fmt::format("{:.1f}°", angle); }

std::string full_number(double value) {
  if (std::isnan(value)) return "not defined";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

std::string count(std::uint64_t value) { return grouped(value); }

std::string rate(double value) { return std::isfinite(value) ? with_prefix(value) : "–"; }

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string without_middle(std::string_view text, std::size_t letters) {
  if (text.size() <= letters) return std::string(text);
  const auto inside = [&](std::size_t at) { return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U; };
  std::size_t end = (letters + 1) / 2, rest = text.size() - letters / 2;
  while (inside(end)) --end;
  while (inside(rest)) ++rest;
  return std::string(text.substr(0, end)) + "…" + std::string(text.substr(rest));
}

std::string size_course_text(double before, double after) {
  return std::isfinite(after) ? fmt::format("{:.3f} → {:.3f}", before, after) : "–";
}

std::string size_course_details(const SizeCourse& sizes) {
  return fmt::format("sizes: {} → {}\ntheir logarithms: {} → {}", full_number(sizes.before.sizes), full_number(sizes.after.sizes),
                     full_number(sizes.before.logarithms), full_number(sizes.after.logarithms));
}

std::string duration(double seconds) {
  if (!std::isfinite(seconds)) return "–";
  if (seconds >= 100.0) return fmt::format("{:.0f} s", seconds);
  if (seconds >= 1.0) return fmt::format("{:.3g} s", seconds);
  if (seconds >= 1e-3) return fmt::format("{:.3g} ms", seconds * 1e3);
  return fmt::format("{:.3g} µs", seconds * 1e6);
}

std::string metric_title(Metric metric) { return std::string(info(metric).title); }

std::string with_arrows(std::string text) {
  for (std::size_t at = text.find("->"); at != std::string::npos; at = text.find("->", at)) text.replace(at, 2, "→");
  return text;
}

std::string capitalised(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text;
}

std::vector<std::string> short_names(std::span<const std::string> files) {
  std::vector<std::string> names;
  for (const std::string& file : files) {
    const std::filesystem::path path(file);
    const auto rival = [&](const std::string& other) {
      return other != file && std::filesystem::path(other).filename() == path.filename();
    };
    std::string name = path.filename().string();
    if (std::ranges::any_of(files, rival)) {
      const auto depth = static_cast<std::size_t>(std::distance(path.begin(), path.end()));
      std::size_t count = 1;
      const auto alike = [&](const std::string& other) { return rival(other) && folders_of(other, count) == folders_of(path, count); };
      while (count < depth && std::ranges::any_of(files, alike)) ++count;
      name += "   " + folders_of(path, count);
    }
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace dmoscope::ui
