// dmoscope render: a picture of a mesh coloured by quality, without a window.

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

#include "app/targets.h"
#include "app/text.h"
#include "app/verbs/verbs.h"
#include "core/base/error.h"
#include "core/quality/metric.h"

#ifdef DMOSCOPE_HAVE_GUI
#include "app/console.h"
#include "app/window/picture.h"
#endif

namespace dmoscope::app {
namespace {

constexpr int kLargestSide = 16384;

struct Options {
  std::filesystem::path input, output;
  std::string metric = "mean-ratio";
  std::string size = "1280x800";
  std::string colormap = "viridis";
  std::string range;
  bool transparent = false;
  std::string clip;
};

/// Two numbers with `separator` between them and nothing else; none where the text is something else.
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

std::optional<std::pair<double, double>> parse_range(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto range = parse_pair<double>(text, ':');
  if (!range || !std::isfinite(range->first) || !std::isfinite(range->second) || !(range->first < range->second)) {
    throw UsageError(fmt::format("--range {}: expected LOW:HIGH, two qualities with LOW < HIGH", text));
  }
  return range;
}

int render(const Options& options) {
  if (!options.clip.empty()) throw UsageError("--clip is not in this version: it cuts volume meshes, which are not drawn yet");
  const Metric metric = parse_metric(options.metric);
  const auto [width, height] = parse_size(options.size);
  const auto range = parse_range(options.range);
  if (options.output.extension() != ".png") throw UsageError(fmt::format("{}: pictures are written as .png", options.output.string()));
  require_another_file(options.output, "-o", options.input);
  require_writable(options.output);
#ifdef DMOSCOPE_HAVE_GUI
  PictureLook look;
  look.metric = metric;
  look.width = width;
  look.height = height;
  look.colormap = options.colormap;
  look.range = range;
  look.transparent = options.transparent;
  Watch watch;
  return render_picture(options.input, options.output, look, watch.progress());
#else
  static_cast<void>(metric), static_cast<void>(width), static_cast<void>(height), static_cast<void>(range);
  throw UsageError("this program was built without OpenGL, so it makes no pictures");
#endif
}

}  // namespace

void add_render(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("render", "Make a picture of a mesh; needs no screen");
  verb->add_option("FILE", options->input, "Mesh to read")->required();
  verb->add_option("-o,--output", options->output, "Picture to write")->required()->type_name("SHOT.png");
  verb->add_option("--metric", options->metric, "Metric shown: " + names_of(metric_table()))->type_name("NAME")->capture_default_str();
  verb->add_option("--size", options->size, "Pixels")->type_name("WxH")->capture_default_str();
  verb->add_option("--colormap", options->colormap, "Colour map")->type_name("NAME")->capture_default_str();
  verb->add_option("--range", options->range, "Qualities at the ends of the colour map (0:1 unless given)")->type_name("LO:HI");
  verb->add_flag("--transparent", options->transparent, "Leave the background transparent");
  verb->add_option("--clip", options->clip, "")->group("");
  verb->callback([options, &action] { action = [options] { return render(*options); }; });
}

}  // namespace dmoscope::app
