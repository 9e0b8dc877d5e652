#pragma once
// Output of the experiments' findings: text, CSV, files and a page.

#include <filesystem>
#include <string>
#include <vector>

#include "app/paper/lab.h"

namespace dmoscope::app {

/// One line per finding.
[[nodiscard]] std::string findings_text(const std::vector<Figure>& figures);
/// The findings as CSV, with columns figure,mesh,what,paper,ours,difference,tolerance,verdict,why.
[[nodiscard]] std::string findings_csv(const std::vector<Figure>& figures);
/// The findings as a page without other files. `facts`: settings and machine.
[[nodiscard]] std::string findings_page(const std::vector<Figure>& figures, const std::vector<std::pair<std::string, std::string>>& facts);
/// Writes a folder for each figure that has plots or pictures: plots as SVG and CSV, pictures as PNG. Throws OutputError.
void write_figures(const std::filesystem::path& folder, const std::vector<Figure>& figures);

}  // namespace dmoscope::app
