#include "app/text.h"

#include <cmath>

#include <fmt/format.h>

namespace dmoscope::app {

std::string brief(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : "-"; }

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

void print_json(const Json& object) { fmt::print("{}\n", object.dump(2, ' ', false, Json::error_handler_t::replace)); }

std::string counted(std::uint64_t count, std::string_view singular, std::string_view plural) {
  return fmt::format("{} {}", count, count == 1 ? singular : plural);
}

}  // namespace dmoscope::app
