// dmoscope convert: reads one format, writes another; every vertex stays.

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/console.h"
#include "app/memory_limit.h"
#include "app/targets.h"
#include "app/verbs/verbs.h"
#include "core/io/mesh_io.h"

namespace dmoscope::app {
namespace {

struct Options {
  std::filesystem::path input, output;
  MemoryLimit memory;
};

int convert(const Options& options) {
  require_mesh_target(options.output);
  Watch watch;
  const Mesh mesh = read_mesh(options.input, {watch.progress(), nullptr, options.memory.bytes()});
  for (const std::string& sentence : write_mesh(options.output, mesh, mesh.positions, watch.progress())) {
    complain(fmt::format("{}: {}", options.output.string(), sentence));
  }
  return 0;
}

}  // namespace

void add_convert(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("convert", "Write a mesh in another format; says what that format cannot carry");
  verb->add_option("IN", options->input, "Mesh to read")->required();
  verb->add_option("OUT", options->output, "Where to write it; the format is the extension's")->required();
  add_memory_option(*verb, options->memory);
  verb->callback([options, &action] {
    action = [options] { return within_memory(options->memory, options->input, [options] { return convert(*options); }); };
  });
}

}  // namespace dmoscope::app
