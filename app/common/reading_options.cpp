#include "app/common/reading_options.h"

#include <CLI/CLI.hpp>

#include "core/mesh/geographic.h"
#include "core/mesh/thin.h"

namespace dmoscope::app {

void ReadingOptions::tell(IoContext& reading) const {
  reading.geographic = parse_geographic(geographic);
  reading.thin = parse_thin(thin);
}

void add_reading_options(CLI::App& subcommand, ReadingOptions& options) {
  subcommand
      .add_option(
          "--geographic", options.geographic,
          "Whether x and y are longitude and latitude in degrees, so that elements are judged on the Earth: on, off, or auto: where "
          "the title or the name of a fort.14 or .2dm says so")
      ->type_name("on|off|auto")
      ->capture_default_str();
  subcommand
      .add_option("--thin", options.thin,
                  "Whether a mesh of hexahedra and wedges is one cell thick, so that it is taken for the 2-D mesh of its front, which the "
                  "back follows: on, off, or auto: where it is")
      ->type_name("on|off|auto")
      ->capture_default_str();
}

}  // namespace dmoscope::app
