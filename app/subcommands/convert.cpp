// dmoscope convert: reads one format and writes another; every vertex stays.

#include <algorithm>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/memory_limit.h"
#include "app/common/option_checks.h"
#include "app/common/output_checks.h"
#include "app/common/text.h"
#include "app/subcommands/subcommands.h"
#include "core/base/error.h"
#include "core/input/input_mesh.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/faces.h"
#include "core/mesh/orientation.h"

namespace dmoscope::app {
namespace {

struct Options {
  std::filesystem::path input, output;
  std::size_t pieces = 0;
  MemoryLimit memory;
};

bool becomes_another_format(const std::filesystem::path& output, const Mesh& mesh) {
  const FormatInfo* format = written_format(output, mesh);
  return mesh.source == nullptr || format == nullptr || format->name != mesh.source->format();
}

/// Turns volume elements that are inside out, for programs disagree on the order of corners of VTK's wedges.
void turn_volumes(Mesh& mesh, Progress& progress) {
  const auto kinds = mesh.elements.kinds();
  const auto is_volume = [](ElementKind kind) { return info(kind).dimension == 3; };
  if (kinds.empty() || !std::all_of(kinds.begin(), kinds.end(), is_volume)) return;
  normalise_orientation(mesh, FaceNeighbours(mesh, &progress));
}

int convert(const Options& options) {
  require_mesh_target(options.output, options.input);
  const FormatInfo* format = format_by_extension(mesh_extension(options.output));
  if (options.pieces != 0 && (format == nullptr || format->name != "pvtu"))
    throw UsageError(fmt::format("--pieces: only .pvtu has pieces, not {}", options.output.extension().string()));
  Watch watch;
  Mesh mesh = read_mesh(options.input, {watch.progress(), nullptr, options.memory.bytes()});
  require_computable(classify(mesh), options.input.string(), Need::QualityOnly);
  if (becomes_another_format(options.output, mesh)) turn_volumes(mesh, watch.progress());
  IoContext writing(watch.progress());
  writing.pieces = options.pieces;
  for (const std::string& sentence : write_mesh(options.output, mesh, mesh.positions, writing)) {
    complain(fmt::format("{}: {}", options.output.string(), sentence));
  }
  print("wrote {} ({}, {})\n", options.output.string(), counted(mesh.vertex_count(), "vertex", "vertices"),
        counted(mesh.elements.size(), "element", "elements"));
  return 0;
}

}  // namespace

void add_convert(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* subcommand = app.add_subcommand("convert", "Write a mesh in another format; says what that format cannot carry");
  subcommand->add_option("IN", options->input, "Mesh to read")->required();
  subcommand->add_option("OUT,-o,--output", options->output, "Where to write it; the format is the extension's")->required();
  subcommand->add_option("--pieces", options->pieces, "Of a .pvtu: how many VTU files it has; by default one for each million elements")
      ->transform(whole_number(1, 1'000'000))
      ->type_name("N");
  add_memory_option(*subcommand, options->memory);
  subcommand->callback([options, &action] {
    action = [options] { return within_memory(options->memory, options->input, [options] { return convert(*options); }); };
  });
}

}  // namespace dmoscope::app
