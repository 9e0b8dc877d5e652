#include "app/completion.h"

#include <algorithm>
#include <array>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/mesh/generate.h"
#include "core/quality/metric.h"
#include "core/run/recipe.h"
#include "core/smooth/execution/accelerator.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope::app {
namespace {

template <class Table>
std::vector<std::string> names_in(const Table& table) {
  std::vector<std::string> names;
  for (const auto& row : table) names.emplace_back(row.name);
  return names;
}

/// The words that an option's value can be; empty: any value, such as a file.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string name = option.get_positional() ? option.get_name(true) : option.get_lnames().empty() ? "" : option.get_lnames().front();
  if (name == "metric") return names_in(metric_table());
  if (name == "method") return names_in(method_table());
  if (name == "recipe") return names_in(recipe_table());
  if (name == "KIND") return names_in(generator_table());
  if (name == "backend") {
    std::vector<std::string> names;
    for (const Backend backend : {Backend::Auto, Backend::Cpu, Backend::Cuda}) names.emplace_back(dmoscope::name(backend));
    return names;
  }
  const std::string type = option.get_type_name();
  if (type.find('|') == std::string::npos) return {};
  std::vector<std::string> words;
  for (std::string& word : CLI::detail::split(type, '|'))  // placeholders, such as in shuffle:SEED, are left out
    if (std::none_of(word.begin(), word.end(), [](char c) { return c >= 'A' && c <= 'Z'; })) words.push_back(std::move(word));
  return words;
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  std::vector<const CLI::Option*> options;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) options.push_back(option);
  return options;
}
std::vector<const CLI::App*> subcommands_of(const CLI::App& app) {
  std::vector<const CLI::App*> shown;
  for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!subcommand->get_group().empty()) shown.push_back(subcommand);
  return shown;
}
/// Spellings of an option: "-o", "--output".
std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> all;
  for (const std::string& name : option.get_snames()) all.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) all.push_back("--" + name);
  return all;
}
bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::string bash_case(const CLI::App& app, std::string_view verb) {
  std::string text, all;
  for (const CLI::Option* option : options_of(app)) {
    const auto words = choices_of(*option);
    for (const std::string& spelling : spellings(*option)) {
      all += " " + spelling;
      if (!takes_value(*option)) continue;
      text += fmt::format("    '{} {}') words='{}'; value=1 ;;\n", verb, spelling, fmt::join(words, " "));
    }
  }
  return text + fmt::format("    '{} '*) [[ $cur == -* ]] && words='{}' ;;\n", verb, all.empty() ? all : all.substr(1));
}

std::string bash_script(const CLI::App& app) {
  std::string cases, verbs, positionals;
  for (const CLI::App* subcommand : subcommands_of(app)) {
    verbs += " " + subcommand->get_name();
    cases += bash_case(*subcommand, subcommand->get_name());
    for (const CLI::Option* option : options_of(*subcommand))
      if (const auto words = choices_of(*option); option->get_positional() && !words.empty())
        positionals += fmt::format("    {}) words='{}' ;;\n", subcommand->get_name(), fmt::join(words, " "));
  }
  std::string own;
  for (const CLI::Option* option : options_of(app))
    for (const std::string& spelling : spellings(*option)) own += " " + spelling;
  return fmt::format(R"(# bash completion for dmoscope; made by dmoscope --completion bash
_dmoscope() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} verb=${{COMP_WORDS[1]}} words='' value=0
  COMPREPLY=()
  if [[ $COMP_CWORD -eq 1 ]]; then
    COMPREPLY=($(compgen -W '{}{}' -- "$cur"))
    return
  fi
  case "$verb $prev" in
{}  esac
  if [[ -z $words && $value -eq 0 && $cur != -* ]]; then
    case $verb in
{}    esac
  fi
  [[ -n $words ]] && COMPREPLY=($(compgen -W "$words" -- "$cur"))
}}
complete -o default -F _dmoscope dmoscope
)",
                     verbs.substr(1), own, cases, positionals);
}

/// Escapes text for the quotes of _arguments, where brackets and colons have a meaning of their own.
std::string zsh_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
      continue;
    }
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_options(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : options_of(app)) {
    const auto words = choices_of(*option);
    const std::string action = words.empty() ? "_files" : fmt::format("({})", fmt::join(words, " "));
    if (option->get_positional()) {
      text += fmt::format(" \\\n        '{}{}:{}'", option->get_items_expected_max() > 1 ? "*:" : ":", zsh_text(option->get_name(true)),
                          action);
      continue;
    }
    for (const std::string& spelling : spellings(*option)) {
      text += fmt::format(" \\\n        '{}[{}]", spelling, zsh_text(option->get_description()));
      if (takes_value(*option)) text += fmt::format(":{}:{}", zsh_text(option->get_type_name()), action);
      text += '\'';
    }
  }
  return text;
}

std::string zsh_script(const CLI::App& app) {
  std::string verbs, cases;
  for (const CLI::App* subcommand : subcommands_of(app)) {
    verbs += fmt::format("    '{}:{}'\n", subcommand->get_name(), zsh_text(subcommand->get_description()));
    cases += fmt::format("      {})\n        _arguments -s{} ;;\n", subcommand->get_name(), zsh_options(*subcommand));
  }
  return fmt::format(R"(#compdef dmoscope
# zsh completion for dmoscope; made by dmoscope --completion zsh
_dmoscope() {{
  local -a verbs
  verbs=(
{}  )
  if (( CURRENT == 2 )); then
    _describe -t verbs 'subcommand' verbs
    _arguments{}
    return
  fi
  local verb=$words[2]
  shift words
  (( CURRENT-- ))
  case $verb in
{}      *) _files ;;
  esac
}}
_dmoscope "$@"
)",
                     verbs, zsh_options(app), cases);
}

}  // namespace

std::string completion_script(const CLI::App& app, std::string_view shell) {
  if (shell == "bash") return bash_script(app);
  if (shell == "zsh") return zsh_script(app);
  throw UsageError("--completion: " + unknown_value("shell", shell, std::array<std::string_view, 2>{"bash", "zsh"}));
}

}  // namespace dmoscope::app
