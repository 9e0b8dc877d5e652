#pragma once
// A small checker of markup: every tag is closed, in turn, and every & begins an entity.

#include <cctype>
#include <string>
#include <vector>

namespace dmoscope::test {

/// Describes what is wrong with the page as XML; empty if nothing is.
inline std::string markup_fault(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '&') {
      const std::size_t end = text.find(';', at);
      if (end == std::string::npos || end - at > 8) return "a bare & at " + std::to_string(at);
    }
    if (text[at] != '<') continue;
    std::size_t end = at;
    for (char quote = 0; end < text.size() && (text[end] != '>' || quote != 0); ++end) {
      if (quote == 0 && (text[end] == '"' || text[end] == '\'')) {
        quote = text[end];
      } else if (text[end] == quote) {
        quote = 0;
      } else if (end > at && text[end] == '<') {
        return "a bare < at " + std::to_string(end);
      }
    }
    if (end == text.size()) return "a tag that does not end at " + std::to_string(at);
    const std::string tag = text.substr(at + 1, end - at - 1);
    at = end;
    if (tag.starts_with('!') || tag.starts_with('?') || tag.ends_with('/')) continue;
    std::string name;
    for (const char c : tag.substr(tag.starts_with('/') ? 1 : 0)) {
      if (std::isspace(static_cast<unsigned char>(c)) != 0) break;
      name += c;
    }
    if (!tag.starts_with('/')) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> closes what is not open";
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

}  // namespace dmoscope::test
