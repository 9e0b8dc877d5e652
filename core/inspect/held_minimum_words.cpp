// Reasons that hold the minimum, in words.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/number_text.h"
#include "core/inspect/held_minimum.h"
#include "core/inspect/joint_hold.h"

namespace dmoscope {

namespace {

constexpr std::array<std::string_view, 15> kNames{"free",      "slides",     "deviation", "tilt",    "boundary",
                                                  "interface", "file",       "corner",    "feature", "touching",
                                                  "hand",      "neighbours", "threshold", "tied",    "layer"};
constexpr std::array<std::string_view, 15> kPhrases{"nothing",
                                                    "nothing: it slides",
                                                    "the bound of deviation",
                                                    "how far faces may lean",
                                                    "the fixed boundary",
                                                    "a fixed interface",
                                                    "the file",
                                                    "corners",
                                                    "feature edges",
                                                    "parts that touch there",
                                                    "what is fixed by hand",
                                                    "its neighbours",
                                                    "the threshold of two aims",
                                                    "vertices from which it would part",
                                                    "the boundary layers that are kept"};

}  // namespace

std::string_view name(Holding holding) noexcept { return kNames[static_cast<std::size_t>(holding)]; }
std::string_view phrase(Holding holding) noexcept { return kPhrases[static_cast<std::size_t>(holding)]; }

std::string HoldSwitch::option() const {
  if (name == "unfix") return fmt::format("--fix without {}", value);
  return name == "auto-corner" ? fmt::format("--corner without {}", value) : fmt::format("--{} {}", name, value);
}

std::string HoldSwitch::gives_up() const {
  if (name == "boundary") return "the fixed boundary";
  if (name == "interfaces") return "fixed interfaces";
  if (name == "layers") return "boundary layers";
  if (name == "corner-angle") return fmt::format("corners under {}°", value);
  if (name == "feature-angle") return fmt::format("features under {}°", value);
  if (name == "auto-corner") return fmt::format("corners by hand: {}", value);
  if (name == "unfix") return fmt::format("fixed vertices: {}", value);
  if (name == "max-deviation") return "nearness to the input";
  if (name == "combine") return "the second aim, partly";
  return {};
}

namespace {

/// Number with four significant digits, rounded down.
std::string four_digits_down(double value) {
  std::string text = four_digits(value);
  if (std::isfinite(value) && std::stod(text) > value) {
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3.0);
    text = four_digits(std::stod(text) - unit);
  }
  return text;
}

}  // namespace

std::string SwitchTrial::figures() const {
  return fmt::format("{} -> {} in {} iteration{}", four_digits(before), four_digits_down(after), iterations, iterations == 1 ? "" : "s");
}

std::string SwitchTrial::sentence() const {
  const std::string where = from ? fmt::format(" from iteration {} on", *from) : std::string();
  if (gains()) return fmt::format("tried{}: {}", where, figures());
  return fmt::format("tried{} in {} iteration{}: no gain", where, iterations, iterations == 1 ? "" : "s");
}

std::vector<std::string> HeldMinimum::commands() const {
  std::vector<std::string> all;
  if (change) all.push_back(change->command());
  if (also) all.push_back(also->command());
  return all;
}

std::vector<std::string> HeldMinimum::advice() const {
  std::vector<std::string> lines = commands();
  if (lines.empty()) return lines;
  lines.front() = "continue-with " + lines.front();  // the other switches change the run that this one makes
  lines.emplace_back("until-converged best");
  return lines;
}

std::string HeldMinimum::options() const {
  std::string text = change ? change->option() : "";
  if (also) text += ' ' + also->option();
  return text;
}

std::string HeldMinimum::gives_up() const {
  std::string text = change ? change->gives_up() : "";
  const std::string more = also ? also->gives_up() : "";
  if (!text.empty() && !more.empty()) text += "; ";
  return text + more;
}

bool HeldMinimum::rises() const noexcept { return is_gain(quality, unchanged); }

bool HeldMinimum::is_of_another() const noexcept { return joint && !joint->beyond && !is_as_bad(joint->before, quality); }

bool HeldMinimum::certified() const noexcept {
  return joint && joint->certified && !joint->beyond && !is_of_another() && !is_gain(quality, joint->after);
}

std::string_view HeldMinimum::brief() const noexcept {
  if (change) return phrase(by);
  if (rises()) return "nothing";
  if (is_fixed(by)) return phrase(by);
  return certified() ? "a certified optimum" : unchanged > quality ? "nothing" : "a local optimum";
}

std::string HeldMinimum::outlook() const {
  if (change) return {};
  if (rises()) return "it still rises";
  if (certified() && is_fixed(by)) return fmt::format("no joint move gains, either: {} hold it", holders(*joint).size());
  if (certified())
    return fmt::format("certified: {}",
                       holders(*joint).size() > 1 ? fmt::format("{} hold it", holders(*joint).size()) : std::string("nothing raises it"));
  if (is_fixed(by)) return "no switch gains here";
  return unchanged > quality ? "it rises slowly" : "its vertices gain nothing";
}

/// Numbers of vertices by reason: "4 of its 8 vertices, 1 by corners, 3 free".
std::string HeldMinimum::shares() const {
  std::string text;
  const auto count = [this](Holding one) { return std::ranges::count(vertices, one, &HeldVertex::by); };
  if (count(by) > 0) text = fmt::format("{} of its {} vertices", count(by), vertices.size());
  for (std::size_t k = kNames.size(); k-- > 0;) {
    const auto other = static_cast<Holding>(k);
    if (other == by || count(other) == 0) continue;
    const std::string how = other == Holding::Nothing ? "free" : other == Holding::Slides ? "sliding" : fmt::format("by {}", phrase(other));
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count(other), how);
  }
  return text;
}

/// Sentence on the switches that were tried in vain; each parameter once.
std::string HeldMinimum::tried(bool as_option) const {
  std::vector<std::string_view> names;
  std::string text;
  for (const HoldSwitch& one : in_vain) {
    if (std::ranges::find(names, one.name) != names.end()) continue;
    names.push_back(one.name);
    text += (text.empty() ? " Tried without a gain here: " : ", ") + (as_option ? one.option() : one.command());
  }
  return text.empty() ? text : text + ".";
}

std::string HeldMinimum::sentence(bool as_option) const {
  std::string text = hold_sentence(as_option);
  if (joint && !change && !rises()) {
    if (is_of_another())
      text +=
          fmt::format(" Of those that moves can change, element {} at {} is the worst.", joint->worst_element, four_digits(joint->before));
    if (joint->beyond && is_gain(joint->before, joint->after)) return text + fmt::format(" Joint moves raise {}.", joint->aim);
    text += is_of_another() && is_gain(joint->before, joint->after) ? " Joint moves raise it." : ' ' + certificate_sentence(*joint);
  }
  if (untried.empty()) return text;
  return text + fmt::format(" Not looked at further: {}{}.", fmt::join(untried, ", "), as_option ? " (--hints full does)" : "");
}

std::string HeldMinimum::hold_sentence(bool as_option) const {
  std::string text;
  if (ceiling)
    text = fmt::format("Element {} at {} stays: no option that was tried frees one of its vertices. ", ceiling->first,
                       four_digits(ceiling->second));
  text += fmt::format("{} {} at {} is {}", ceiling ? "Of those that move element" : "Element", element, four_digits(quality),
                      ceiling ? "the worst" : "the worst of all");
  const bool all_tried = untried.empty();
  if (!all_tried && !change && !rises() && is_fixed(by))
    return text + fmt::format(". Held by {}: {}.", phrase(by), shares()) + tried(as_option);
  if (!all_tried && untried.front() == kMoreIterations) return text + ". Its vertices can move.";
  if (!change && rises()) return text + ", and nothing holds it: more iterations raise it.";
  if (!change && !is_fixed(by))
    return text + (unchanged > quality ? ". Nothing holds it: more iterations raise it slowly." : ". It is at a local optimum.") +
           tried(as_option);
  text += fmt::format(". It is held by {} ({})", phrase(by), shares());
  if (!change) return text + '.' + tried(as_option);
  return text + ": " + gain(as_option) + (rises() ? ". More iterations alone raise it, too." : ".");
}

/// Sentence on the gain of the change, what it gives up, and its result on the whole mesh if that was tried.
std::string HeldMinimum::gain(bool as_option) const {
  const std::string with = as_option ? options() : fmt::format("{}", fmt::join(commands(), " with "));
  const std::string given_up = gives_up();
  return fmt::format("{} would free it{}; {}", with, given_up.empty() ? "" : fmt::format(" (giving up {})", given_up),
                     trial ? trial->sentence() : "on the whole mesh that was not tried");
}

}  // namespace dmoscope
