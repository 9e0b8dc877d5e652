#include "app/common/geographic_option.h"

#include <CLI/CLI.hpp>

namespace dmoscope::app {

void add_geographic_option(CLI::App& subcommand, GeographicOption& option) {
  subcommand
      .add_option(
          "--geographic", option.word,
          "Whether x and y are longitude and latitude in degrees, so that elements are judged on the Earth: on, off, or auto: where "
          "the title or the name of a fort.14 or .2dm says so")
      ->type_name("on|off|auto")
      ->capture_default_str();
}

}  // namespace dmoscope::app
