#include "app/paper/figure.h"

#include <cmath>

#include <fmt/format.h>

namespace dmoscope::app {

std::string_view name(Verdict verdict) {
  constexpr std::array<std::string_view, 5> kNames{"holds", "differs", "told", "no mesh", "not possible"};
  return kNames[static_cast<std::size_t>(verdict)];  // in the order of Verdict
}

Claim Claim::about(double value, double tolerance, std::string why) {
  return {fmt::format("{:g} ± {:g}", value, tolerance), value, value - tolerance, value + tolerance, std::move(why)};
}

std::string Claim::tolerance() const {
  if (!std::isfinite(highest)) return fmt::format("at least {:.4g}", lowest);
  if (!std::isfinite(lowest)) return fmt::format("at most {:.4g}", highest);
  return fmt::format("{:.4g} to {:.4g}", lowest, highest);
}

void Figure::check(std::string mesh, std::string what, double ours, Claim claim) {
  std::optional<double> difference;
  if (claim.value) difference = ours - *claim.value;
  const Verdict verdict = claim.holds(ours) ? Verdict::Holds : Verdict::Differs;
  findings.push_back(
      {id, std::move(mesh), std::move(what), std::move(claim.paper), ours, difference, claim.tolerance(), verdict, std::move(claim.why)});
}

void Figure::tell(std::string mesh, std::string what, double ours, std::string paper, std::string why) {
  findings.push_back({id, std::move(mesh), std::move(what), std::move(paper), ours, {}, {}, Verdict::Told, std::move(why)});
}

void Figure::lack(std::string mesh, std::string what, Verdict verdict, std::string why) {
  Finding finding{.figure = id, .mesh = std::move(mesh), .what = std::move(what), .paper = {}};
  finding.verdict = verdict;
  finding.why = std::move(why);
  findings.push_back(std::move(finding));
}

}  // namespace dmoscope::app
