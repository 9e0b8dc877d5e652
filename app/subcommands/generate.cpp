// dmoscope generate: makes a sample mesh.

#include "core/mesh/generate.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/option_checks.h"
#include "app/common/output_checks.h"
#include "app/common/text.h"
#include "app/subcommands/subcommands.h"
#include "core/io/mesh_io.h"

namespace dmoscope::app {
namespace {

struct GenerateOptions {
  std::string kind;
  std::filesystem::path output;
  std::size_t size = 0;
  std::uint64_t seed = 1;
};

int generate(const GenerateOptions& options) {
  require_mesh_target(options.output);
  Watch watch;
  const Mesh mesh = generate_mesh(options.kind, options.size, options.seed, watch.progress());
  for (const std::string& sentence : write_mesh(options.output, mesh, mesh.positions, watch.progress())) {
    complain(fmt::format("{}: {}", options.output.string(), sentence));
  }
  print("wrote {} ({}, {})\n", options.output.string(), counted(mesh.vertex_count(), "vertex", "vertices"),
        counted(mesh.elements.size(), "element", "elements"));
  return 0;
}

std::string list_of_kinds() {
  std::string text = "Kinds:";
  for (const GeneratorInfo& generator : generator_table()) {
    text += fmt::format("\n  {:<9} {} (about {} vertices)", generator.name, generator.doc, generator.default_size);
  }
  return text;
}

}  // namespace

void add_generate(CLI::App& app, Action& action) {
  auto options = std::make_shared<GenerateOptions>();
  CLI::App* subcommand = app.add_subcommand("generate", "Make a sample mesh");
  subcommand->add_option("KIND", options->kind, "One of " + names_of(generator_table()))->required();
  subcommand->add_option("-o,--output", options->output, "Where to write it; the format is the extension's")->required()->type_name("OUT");
  subcommand->add_option("--size", options->size, "About how many vertices; 0: the kind's own size")
      ->transform(whole_number(0, kNoIndex))
      ->type_name("N")
      ->capture_default_str();
  subcommand->add_option("--seed", options->seed, "The same seed gives the same mesh everywhere")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->type_name("S")
      ->capture_default_str();
  subcommand->footer(list_of_kinds());
  subcommand->callback([options, &action] { action = [options] { return generate(*options); }; });
}

}  // namespace dmoscope::app
