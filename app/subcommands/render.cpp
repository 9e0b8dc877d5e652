// dmoscope render: draws a mesh coloured by quality, without a window.

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/memory_limit.h"
#include "app/common/option_checks.h"
#include "app/common/output_checks.h"
#include "app/common/shared_options.h"
#include "app/common/text.h"
#include "app/subcommands/subcommands.h"
#include "core/base/error.h"
#include "core/base/vec.h"
#include "core/clipping/clip_to_text.h"
#include "core/quality/metric.h"

#ifdef DMOSCOPE_HAVE_GUI
#include "app/common/console.h"
#include "app/window/picture.h"
#endif

namespace dmoscope::app {
namespace {

constexpr int kLargestSide = 16384;

struct RenderOptions {
  std::filesystem::path input, output;
  MemoryLimit memory;
  ReadingOptions reading;
  std::string metric = "mean-ratio";
  std::string size = "1280x800";
  std::string colormap = "beacon";
  std::string range = "input";
  double zoom = 1.0;
  std::string at;
  bool shading = false, no_occlusion = false;
  bool transparent = false;
  std::string clip, clip_mode = "crinkle", isolate, from = "iso", up = "auto";
  std::uint64_t peel = 0, worst = 0;
  std::optional<float> peel_quality;
  double shrink = 1.0;
  bool perspective = false;
};

/// Parses two numbers with `separator` between them; none for other text.
template <class Number>
std::optional<std::pair<Number, Number>> parse_pair(std::string_view text, char separator) {
  std::pair<Number, Number> result{};
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, result.first);
  if (first.ec != std::errc{} || first.ptr == end || *first.ptr != separator) return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, result.second);
  if (second.ec != std::errc{} || second.ptr != end) return std::nullopt;
  return result;
}

std::pair<int, int> parse_size(const std::string& text) {
  const auto size = parse_pair<int>(text, 'x');
  const auto fits = [](int side) { return side >= 1 && side <= kLargestSide; };
  if (!size || !fits(size->first) || !fits(size->second)) {
    throw UsageError(fmt::format("--size {}: expected WIDTHxHEIGHT in pixels, each 1 to {}", text, kLargestSide));
  }
  return *size;
}

/// Parses "X,Y" or "X,Y,Z"; none for an empty text.
std::optional<Vec3> parse_point(std::string_view text) {
  if (text.empty()) return std::nullopt;
  std::array<double, 3> numbers{};
  std::size_t count = 0;
  const char *at = text.data(), *const end = at + text.size();
  for (;;) {
    const auto [next, error] = std::from_chars(at, end, numbers[count]);
    if (error != std::errc{} || !std::isfinite(numbers[count])) break;
    ++count;
    if (next == end && count >= 2) return Vec3{numbers[0], numbers[1], numbers[2]};
    if (next == end || *next != ',' || count == numbers.size()) break;
    at = next + 1;
  }
  throw UsageError(fmt::format("--at {}: expected X,Y or X,Y,Z, a place in the mesh's coordinates", text));
}

/// Range of colours, by the words of the window's command `range`; for a single mesh some of them mean the same.
struct RangeWish {
  enum class Spans { All, Own, Percentiles } spans = Spans::All;
  std::pair<double, double> percent{2.0, 98.0};
  std::optional<std::pair<double, double>> given;
};

RangeWish parse_range(const std::string& text) {
  constexpr std::string_view kPercentile = "percentile";
  RangeWish wish;
  if (text == "input") return wish;
  if (text == "fixed") {
    wish.given = {0.0, 1.0};
    return wish;
  }
  if (text == "auto" || text == "expanding") {
    wish.spans = RangeWish::Spans::Own;
    return wish;
  }
  const bool percentile = text.starts_with(kPercentile);
  if (percentile) wish.spans = RangeWish::Spans::Percentiles;
  if (text == kPercentile) return wish;
  const auto range = parse_pair<double>(percentile ? text.substr(std::min(text.size(), kPercentile.size() + 1)) : text, ':');
  const bool good = range && std::isfinite(range->first) && std::isfinite(range->second) && range->first < range->second;
  if (!good || (percentile && (text[kPercentile.size()] != ':' || range->first < 0.0 || range->second > 100.0))) {
    throw UsageError(
        fmt::format("--range {}: expected input, fixed, auto, expanding, percentile, percentile:LOW:HIGH, or LOW:HIGH, two qualities with "
                    "LOW < HIGH",
                    text));
  }
  (percentile ? wish.percent : wish.given.emplace()) = *range;
  return wish;
}

/// The visible part of a volume mesh, except the clip plane.
ClippingView inside_view(const RenderOptions& options) {
  ClippingView view;
  view.clip.mode = parse_clip_mode(options.clip_mode);
  if (options.clip.empty() && view.clip.mode != ClipPlane::Mode::Crinkle) throw UsageError("--clip-mode: there is no --clip");
  view.peel = static_cast<Index>(options.peel);
  view.peel_quality = options.peel_quality;
  if (!options.isolate.empty()) {
    view.isolate = parse_pair<float>(options.isolate, ':');
    if (!view.isolate || !(view.isolate->first <= view.isolate->second)) {
      throw UsageError(fmt::format("--isolate {}: expected LOW:HIGH, two qualities with LOW <= HIGH", options.isolate));
    }
  }
  view.worst = options.worst;
  view.ghost = options.worst > 0;
  view.shrink = options.shrink;
  if (!(view.shrink > 0.0 && view.shrink <= 1.0)) throw UsageError("--shrink: expected a factor greater than 0 and at most 1");
  return view;
}

int render(const RenderOptions& options) {
  const Metric metric = parse_metric(options.metric);
  const auto [width, height] = parse_size(options.size);
  const auto range = parse_range(options.range);
  const ClippingView view = inside_view(options);
  const std::optional<Vec3> at = parse_point(options.at);
  constexpr double kMostZoom = 1e6;
  if (!(options.zoom > 0.0 && options.zoom <= kMostZoom))
    throw UsageError(fmt::format("--zoom: expected a factor above 0, up to {:g}", kMostZoom));
  if (options.output.extension() != ".png") throw UsageError(fmt::format("{}: pictures are written as .png", options.output.string()));
  require_another_file(options.output, "-o", options.input);
  require_writable(options.output);
#ifdef DMOSCOPE_HAVE_GUI
  PictureLook look;
  look.metric = metric;
  look.width = width;
  look.height = height;
  look.colormap = options.colormap;
  look.range = range.given;
  if (range.spans == RangeWish::Spans::Own) look.spans = PictureLook::Spans::Own;
  if (range.spans == RangeWish::Spans::Percentiles) look.spans = PictureLook::Spans::Percentiles;
  look.percent = range.percent;
  look.shading = options.shading;
  look.occlusion = !options.no_occlusion;
  look.transparent = options.transparent;
  look.zoom = options.zoom;
  look.at = at;
  const InsideLook inside{options.clip, view, options.from, options.up, options.perspective};
  require_sense(inside);
  Watch watch;
  IoContext reading(watch.progress(), nullptr, options.memory.bytes());
  options.reading.tell(reading);
  const int code = render_picture(options.input, options.output, look, inside, reading);
  if (code == 0) print("wrote {} ({} x {} pixels)\n", options.output.string(), width, height);
  return code;
#else
  static_cast<void>(view), static_cast<void>(at), static_cast<void>(metric), static_cast<void>(width), static_cast<void>(height),
      static_cast<void>(range.given);
  throw UsageError("this program was built without OpenGL, so it makes no pictures");
#endif
}

/// Adds the options of volume meshes.
void add_inside(CLI::App& subcommand, RenderOptions& options) {
  const auto option = [&subcommand](const char* name, auto& value, const char* type, const char* doc) {
    return subcommand.add_option(name, value, doc)->type_name(type)->group("Volume meshes");
  };
  option(
      "--clip", options.clip, "PLANE",
      "Take away what lies beyond a plane: x, y or z, half-way through the mesh or at :FRACTION (0 to 1), -x, -y, -z: the other side; or "
      "NX,NY,NZ:OFFSET");
  option("--clip-mode", options.clip_mode, "MODE", "crinkle: whole elements, cut: cut through")->capture_default_str();
  option("--peel", options.peel, "N", "Take so many layers of elements off the boundary")->transform(whole_number(0, 0xfffffffe));
  option("--peel-quality", options.peel_quality, "Q", "Take elements of a higher quality away");
  option("--isolate", options.isolate, "LO:HI", "Only elements of a quality in this range");
  option("--worst", options.worst, "N", "Only the N worst elements, in a faint boundary of the rest")
      ->transform(whole_number(1, 0xfffffffe));
  option("--shrink", options.shrink, "F", "Draw every element F times as large")->capture_default_str();
  option("--view", options.from, "VIEW", "Look from: iso, +x, -x, +y, -y, +z, -z")->capture_default_str();
  option("--up", options.up, "AXIS", "Axis that points up: z, y, or auto, on what the mesh stands")
      ->check(CLI::IsMember({"auto", "z", "y"}))
      ->capture_default_str();
  subcommand.add_flag("--perspective", options.perspective, "What is farther away looks smaller")->group("Volume meshes");
  subcommand.add_flag("--shading", options.shading, "Lit by a lamp, too, which changes what the colours tell")->group("Volume meshes");
  subcommand.add_flag("--no-occlusion", options.no_occlusion, "Not darker in corners and along edges")->group("Volume meshes");
}

}  // namespace

void add_render(CLI::App& app, Action& action) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* subcommand = app.add_subcommand("render", "Make a picture of a mesh; needs no screen");
  subcommand->add_option("FILE", options->input, "Mesh to read")->required();
  subcommand->add_option("-o,--output", options->output, "Picture to write")->required()->type_name("SHOT.png");
  subcommand->add_option("--metric", options->metric, "Metric shown: " + names_of_metrics())->type_name("NAME")->capture_default_str();
  subcommand->add_option("--size", options->size, "Pixels")->type_name("WxH")->capture_default_str();
  subcommand->add_option("--colormap", options->colormap, "Colour map")->type_name("NAME")->capture_default_str();
  subcommand
      ->add_option("--range", options->range,
                   "Qualities at the ends of the colour map: input (the mesh's own, rounded outwards), fixed (0 to 1), auto (its own), "
                   "percentile[:LO:HI] (2:98 unless given), LO:HI")
      ->type_name("RANGE")
      ->capture_default_str();
  subcommand->add_option("--zoom", options->zoom, "So many times as large as all of the mesh would be shown")
      ->type_name("F")
      ->capture_default_str();
  subcommand->add_option("--at", options->at, "What is in the middle of the picture, in the mesh's coordinates (the mesh's own middle)")
      ->type_name("X,Y[,Z]");
  subcommand->add_flag("--transparent", options->transparent, "Leave the background transparent");
  add_memory_option(*subcommand, options->memory);
  add_reading_options(*subcommand, options->reading);
  add_inside(*subcommand, *options);
  subcommand->callback([options, &action] {
    action = [options] { return within_memory(options->memory, options->input, [options] { return render(*options); }); };
  });
}

}  // namespace dmoscope::app
