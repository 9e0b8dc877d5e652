#include "ui/state/actions.h"

#include <algorithm>
#include <array>

#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

constexpr std::array kActions{
    Action{"open", "File", "Open…", "Ctrl+O", "dialog open"},
    Action{"open-beside", "File", "Open beside…", "Ctrl+Shift+O", "dialog open-beside", Needs::Mesh},
    Action{"surface", "File", "Slide on the surface of…", "", "dialog open-surface", Needs::MeshAndIdle},
    Action{"own-surface", "File", "Slide on its own surface", "", "surface own", Needs::MeshAndIdle},
    Action{"export", "File", "Export mesh…", "Ctrl+S", "dialog export", Needs::Mesh},
    Action{"screenshot", "File", "Screenshot…", "Ctrl+Shift+S", "dialog screenshot", Needs::Mesh},
    Action{"save-session", "File", "Save the session…", "", "dialog save-session", Needs::Mesh},
    Action{"sequence", "File", "Pictures of a run…", "", "dialog sequence", Needs::MeshAndIdle},
    Action{"reload", "File", "Read the file again", "F5", "reload", Needs::MeshAndIdle, true},
    Action{"watch", "File", "Watch the file", "", "watch toggle"},
    Action{"sample-coast", "File", "Sample: coast", "", "generate coast", Needs::Nothing, true},
    Action{"sample-block", "File", "Sample: block", "", "generate block"},
    Action{"sample-annulus", "File", "Sample: annulus", "", "generate annulus"},
    Action{"sample-random", "File", "Sample: random", "", "generate random"},
    Action{"sample-quads", "File", "Sample: quads", "", "generate quads"},
    Action{"sample-mixed", "File", "Sample: mixed", "", "generate mixed"},
    Action{"sample-tangled", "File", "Sample: tangled", "", "generate tangled"},
    Action{"sample-grid", "File", "Sample: grid", "", "generate grid"},
    Action{"sample-wrapped", "File", "Sample: wrapped", "", "generate wrapped"},
    Action{"sample-globe", "File", "Sample: globe", "", "generate globe"},
    Action{"sample-tetrahedra", "File", "Sample: tetrahedra", "", "generate tetrahedra", Needs::Nothing, true},
    Action{"sample-hexahedra", "File", "Sample: hexahedra", "", "generate hexahedra"},
    Action{"sample-solids", "File", "Sample: solids", "", "generate solids"},
    Action{"sample-tangled-solids", "File", "Sample: tangled-solids", "", "generate tangled-solids"},
    Action{"sample-screw", "File", "Sample: screw", "", "generate screw"},
    Action{"sample-elbow", "File", "Sample: elbow", "", "generate elbow"},
    Action{"sample-can", "File", "Sample: can", "", "generate can"},
    Action{"sample-nested", "File", "Sample: nested", "", "generate nested"},
    Action{"sample-nested-solids", "File", "Sample: nested-solids", "", "generate nested-solids"},
    Action{"sample-anisotropic", "File", "Sample: anisotropic", "", "generate anisotropic"},
    Action{"sample-biased", "File", "Sample: biased", "", "generate biased"},
    Action{"native-dialogs", "File", "The desktop's file dialogs", "", "native-dialogs toggle", Needs::Nothing, true},
    Action{"quit", "File", "Quit", "Ctrl+Q", "quit", Needs::Nothing, true},

    Action{"undo", "Edit", "Undo", "Ctrl+Z", "undo", Needs::Undo},
    Action{"redo", "Edit", "Redo", "Ctrl+Y", "redo", Needs::Redo},
    Action{"find", "Edit", "Find vertex or element…", "Ctrl+F", "dialog find", Needs::Mesh, true},
    Action{"leave", "Edit", "Leave the brush, or clear the selection", "Escape", "leave", Needs::Leavable},
    Action{"pick-none", "Edit", "Clear selection", "", "pick none", Needs::Picked},
    Action{"rename-run", "Edit", "Rename the run…", "Shift+F2", "begin-rename", Needs::Mesh, true},

    Action{"run-pause", "Run", "Run / pause", "Space", "run-pause", Needs::Mesh},
    Action{"run-10", "Run", "Run 10 iterations", "Shift+N", "run 10", Needs::MeshAndIdle},
    Action{
        "make-good", "Run", "Make it good", "Shift+U", "make-good", Needs::MeshAndIdle, false,
        "All that there is, until it has converged: DMO, then joint moves until the minimum is within 0.3 % of what can be reached, then "
        "the best mean that keeps it. The run before is kept."},
    Action{"until-converged", "Run", "Until converged", "U", "until-converged best", Needs::MeshAndIdle},
    Action{"cancel", "Run", "Cancel", "Shift+Escape", "cancel", Needs::Work},
    Action{"step-iteration", "Run", "Next iteration", "N", "step iteration", Needs::MeshAndIdle, true},
    Action{"step-class", "Run", "Next colour class", "C", "step class", Needs::MeshAndIdle},
    Action{"step-vertex", "Run", "Next vertex", "V", "step vertex", Needs::MeshAndIdle},
    Action{"back-iteration", "Run", "Back one iteration", "B", "back iteration", Needs::MeshAndIdle, true},
    Action{"back-class", "Run", "Back one colour class", "Shift+C", "back class", Needs::MeshAndIdle},
    Action{"back-vertex", "Run", "Back one vertex", "Shift+V", "back vertex", Needs::MeshAndIdle},
    Action{"reset", "Run", "Reset to the input", "R", "reset", Needs::MeshAndIdle},
    Action{"formula", "Run", "A metric of your own…", "", "dialog formula", Needs::Mesh, true},
    Action{"timeline-back", "Run", "Timeline: earlier", "[", "timeline back", Needs::MeshAndIdle, true},
    Action{"timeline-forward", "Run", "Timeline: later", "]", "timeline forward", Needs::MeshAndIdle},
    Action{"timeline-first", "Run", "Timeline: input", "Home", "timeline first", Needs::MeshAndIdle},
    Action{"timeline-last", "Run", "Timeline: latest", "End", "timeline last", Needs::MeshAndIdle},
    Action{"best", "Run", "Timeline: best iteration", "Shift+End", "best", Needs::Better},
    Action{"play", "Run", "Play the history", "P", "play toggle", Needs::Mesh, true},
    Action{"play-iterations", "Run", "Step iterations until stopped", "Shift+P", "play-steps iteration", Needs::Mesh},
    Action{"play-classes", "Run", "Step colour classes until stopped", "", "play-steps class", Needs::Mesh},
    Action{"play-vertices", "Run", "Step vertices until stopped", "", "play-steps vertex", Needs::Mesh},
    Action{"slower", "Run", "Play slower", ",", "speed down"},
    Action{"faster", "Run", "Play faster", ".", "speed up"},
    Action{"mark-a", "Run", "Mark what is shown as A", "Shift+A", "mark a", Needs::Mesh, true},
    Action{"mark-b", "Run", "Mark what is shown as B", "Shift+B", "mark b", Needs::Mesh},
    Action{"flip", "Run", "Flip between A and B", "X", "flip", Needs::Mesh},
    Action{"flip-now", "Run", "Back to the current mesh", "Shift+X", "flip now", Needs::Mesh},
    Action{"next-run", "Run", "Next run", "Alt+N", "next-run", Needs::SeveralRuns, true},

    Action{"compare-runs", "Compare", "Methods and metrics…", "", "dialog compare", Needs::MeshAndIdle},
    Action{"every-method", "Compare", "Same metric, every method", "", "compare methods", Needs::MeshAndIdle},
    Action{"every-metric", "Compare", "Same mesh, every metric", "", "compare metrics", Needs::MeshAndIdle},
    Action{"every-order", "Compare", "Same run, 10 shuffled orders", "", "compare orders 10", Needs::MeshAndIdle},
    Action{"each-step", "Compare", "Every run: next iteration", "Ctrl+N", "each step", Needs::MeshAndIdle, true},
    Action{"each-10", "Compare", "Every run: 10 iterations", "Ctrl+Shift+N", "each run 10", Needs::MeshAndIdle},
    Action{"each-converged", "Compare", "Every run: until converged", "Ctrl+U", "each until-converged best", Needs::MeshAndIdle},
    Action{"each-back", "Compare", "Every run: back one iteration", "Ctrl+B", "each back", Needs::MeshAndIdle},
    Action{"each-reset", "Compare", "Every run: reset to the input", "Ctrl+R", "each reset", Needs::MeshAndIdle},
    Action{"viewports-1", "Compare", "One viewport", "1", "viewports 1", Needs::Nothing, true},
    Action{"viewports-2", "Compare", "Two viewports", "2", "viewports 2"},
    Action{"viewports-split", "Compare", "Split view", "3", "viewports split"},
    Action{"viewports-4", "Compare", "Four viewports", "4", "viewports 4"},
    Action{"link-cameras", "Compare", "One camera for all viewports", "", "link-cameras toggle", Needs::Planar},

    Action{"next-class", "Stepping", "Show vertices that move next", "H", "next-class toggle", Needs::Mesh},
    Action{"arrows-previous", "Stepping", "Arrows of the last step", "A", "arrows previous toggle", Needs::Mesh},
    Action{"arrows-input", "Stepping", "Arrows from the input", "Alt+A", "arrows input toggle", Needs::Mesh},
    Action{"arrows-longer", "Stepping", "Longer arrows", "Ctrl+A", "arrow-scale up", Needs::Mesh},
    Action{"arrows-shorter", "Stepping", "Shorter arrows", "Ctrl+Shift+A", "arrow-scale down", Needs::Mesh},
    Action{"arrows-auto", "Stepping", "Automatic arrow length", "", "arrow-scale auto", Needs::Mesh},
    Action{"flash", "Stepping", "Flash what a step moves", "", "flash toggle"},
    Action{"ghost-previous", "Stepping", "Ghost of the mesh before the last step", "O", "ghost previous toggle", Needs::Mesh},
    Action{"ghost-input", "Stepping", "Ghost of the input", "Shift+O", "ghost input toggle", Needs::Mesh},
    Action{"brush", "Stepping", "Brush: drag to select vertices", "S", "brush toggle", Needs::Planar, true},
    Action{"brush-wider", "Stepping", "Wider brush", "Shift+S", "brush-radius up", Needs::Planar},
    Action{"brush-narrower", "Stepping", "Narrower brush", "Alt+S", "brush-radius down", Needs::Planar},
    Action{"smooth-selected", "Stepping", "Smooth the selected vertices", "Ctrl+Space", "smooth-selected", Needs::Selected, true},
    Action{"fix-selected", "Stepping", "Fix the selected vertices", "Ctrl+Shift+F", "fix-selected", Needs::Selected},
    Action{"select-none", "Stepping", "Select no vertices", "Ctrl+D", "select none", Needs::Selected},
    Action{"click-smooths", "Stepping", "Smooth the vertex that is clicked", "T", "click-smooths toggle", Needs::Mesh, true},

    Action{"fit", "View", "Fit", "F", "fit", Needs::Mesh},
    Action{"zoom-in", "View", "Zoom in", "+", "zoom 1.25", Needs::Mesh},
    Action{"zoom-out", "View", "Zoom out", "-", "zoom 0.8", Needs::Mesh},
    Action{"next-metric", "View", "Show the next metric", "M", "next-metric", Needs::Mesh, true},
    Action{"wireframe", "View", "Wireframe", "W", "wireframe toggle"},
    Action{"vertices", "View", "Vertices", "D", "vertices toggle", Needs::Planar},
    Action{"pointer-value", "View", "Value under the resting pointer", "", "pointer-value toggle"},
    Action{"worst-marker", "View", "Mark the worst element", "K", "worst toggle"},
    Action{"features", "View", "Feature edges and corners, where vertices slide", "Alt+K", "features toggle"},
    Action{"holders", "View", "What holds the minimum: elements that hold one another", "Alt+O", "holders toggle", Needs::Mesh},
    Action{"inside-clip", "View", "Clip plane", "J", "clip toggle", Needs::Volume},
    Action{"inside-axis", "View", "Clip plane across the next axis", "Ctrl+J", "clip next", Needs::Volume},
    Action{"inside-flip", "View", "Clip plane: the other side", "Shift+J", "clip flip", Needs::Volume},
    Action{"inside-cut", "View", "Cut cells through, or whole ones", "Alt+J", "clip-mode toggle", Needs::Volume},
    Action{"inside-peel", "View", "Peel one more layer off", "Y", "peel more", Needs::Volume, true},
    Action{"inside-unpeel", "View", "Put one layer back", "Shift+Y", "peel less", Needs::Volume},
    Action{"inside-shrink", "View", "Shrunk cells", "E", "shrink toggle", Needs::Volume},
    Action{"inside-worst", "View", "Only the worst cells, in a faint rest", "Q", "worst-cells toggle", Needs::Volume},
    Action{"inside-ghost", "View", "What was taken away stays faintly", "Alt+Q", "ghost-rest toggle", Needs::Volume},
    Action{"inside-all", "View", "Show all cells", "Z", "show-all", Needs::Volume, true},
    Action{"from-iso", "View", "Look at a corner", "Alt+I", "view-from iso", Needs::Volume},
    Action{"from-x", "View", "Look from +x", "Alt+X", "view-from +x", Needs::Volume, true},
    Action{"from-minus-x", "View", "Look from -x", "Shift+Alt+X", "view-from -x", Needs::Volume},
    Action{"from-y", "View", "Look from +y", "Alt+Y", "view-from +y", Needs::Volume},
    Action{"from-minus-y", "View", "Look from -y", "Shift+Alt+Y", "view-from -y", Needs::Volume},
    Action{"from-z", "View", "Look from +z", "Alt+Z", "view-from +z", Needs::Volume},
    Action{"from-minus-z", "View", "Look from -z", "Shift+Alt+Z", "view-from -z", Needs::Volume},
    Action{"from-perspective", "View", "Perspective", "Alt+E", "perspective toggle", Needs::Volume, true},
    Action{"from-trackball", "View", "A drag rolls it as a ball", "", "trackball toggle", Needs::Volume},
    Action{"panel-left", "View", "Setup: runs, method, metric", "F2", "panel setup toggle", Needs::Nothing, true},
    Action{"panel-right", "View", "Facts: mesh, selection, worst", "F3", "panel facts toggle"},
    Action{"panel-bottom", "View", "Bottom panel: plots", "F4", "panel bottom toggle"},
    Action{"full-screen", "View", "Full screen", "F11", "full-screen toggle"},
    Action{"theme-dark", "View", "Theme: dark", "", "theme dark", Needs::Nothing, true},
    Action{"theme-light", "View", "Theme: light", "", "theme light"},
    Action{"theme-contrast", "View", "Theme: high contrast", "", "theme contrast"},
    Action{"scale-up", "View", "Larger interface", "Ctrl+=", "scale up"},
    Action{"scale-down", "View", "Smaller interface", "Ctrl+-", "scale down"},
    Action{"scale-one", "View", "Interface at its usual size", "Ctrl+0", "scale 1"},
    Action{"unfold-left", "View", "Narrow window: show the runs panel", "", "unfold left toggle"},
    Action{"unfold-right", "View", "Narrow window: show the inspector", "", "unfold right toggle"},
    Action{"notice-off", "View", "Hide the note about the run's end", "", "notice off"},
    Action{"log", "View", "Log of commands and messages…", "F6", "dialog log", Needs::Nothing, true},

    Action{"plot-convergence", "Plot", "Convergence", "Alt+1", "plot convergence"},
    Action{"plot-histogram", "Plot", "Histogram", "Alt+2", "plot histogram"},
    Action{"plot-sorted", "Plot", "Sorted quality", "Alt+3", "plot sorted"},
    Action{"plot-moved", "Plot", "Moved vertices", "Alt+4", "plot moved"},
    Action{"plot-time", "Plot", "Time", "Alt+5", "plot time"},
    Action{"plot-runs", "Plot", "Table of runs", "Alt+6", "plot runs"},
    Action{"plot-compare", "Plot", "Comparison of runs", "Alt+7", "plot compare"},
    Action{"log-scale", "Plot", "Next value axis", "Alt+L", "axis next", Needs::Nothing, true},
    Action{"plot-seconds", "Plot", "Seconds instead of iterations", "Alt+T", "plot-x toggle"},
    Action{"x-axis-log", "Plot", "Iterations by their logarithm", "", "x-axis log"},
    Action{"x-axis-changes", "Plot", "Iterations up to the last change", "", "x-axis changes"},
    Action{"x-axis-linear", "Plot", "Iterations evenly", "", "x-axis linear"},
    Action{"histogram-whole", "Plot", "Histogram from 0 to 1", "", "histogram-range toggle"},
    Action{"plot-all", "Plot", "The plot as at first", "Alt+0", "plot-zoom all"},
    Action{"plot-save", "Plot", "Save the plot…", "Alt+P", "dialog plot", Needs::Mesh, true},
    Action{"plot-copy", "Plot", "Copy the plot's data", "Alt+C", "plot-copy", Needs::Mesh},

    Action{"inspect", "Inspect", "Grid inspection", "G", "inspect toggle", Needs::Mesh},
    Action{"inspect-next", "Inspect", "The vertex visited next", "Shift+G", "inspect-next", Needs::MeshAndIdle},
    Action{"inspect-worst", "Inspect", "The worst element that can be changed", "Ctrl+G", "inspect-worst", Needs::MeshAndIdle},
    Action{"held-by", "Inspect", "What holds the minimum", "", "held-by", Needs::MeshAndIdle},
    Action{"make-corner", "Inspect", "Corner: the picked vertex stays", "Alt+V", "make corner", Needs::Chosen, true},
    Action{"make-no-corner", "Inspect", "No corner: the picked vertex slides", "Shift+Alt+V", "make no-corner", Needs::Chosen},
    Action{"make-auto-corner", "Inspect", "The picked vertex is a corner where file and angles say so", "", "make auto-corner",
           Needs::Chosen},
    Action{"all-automatic", "Inspect", "All corners as file and angles say", "", "auto-corner", Needs::MeshAndIdle},
    Action{"all-features-automatic", "Inspect", "All feature edges as file and angles say", "", "auto-feature", Needs::MeshAndIdle},
    Action{"level-next", "Inspect", "Next level, then apply", "L", "level next", Needs::MeshAndIdle, true},
    Action{"level-back", "Inspect", "Previous level", "Shift+L", "level back", Needs::MeshAndIdle},
    Action{"level-all", "Inspect", "All levels at once", "Ctrl+L", "level all", Needs::MeshAndIdle},
    Action{"play-levels", "Inspect", "Play the levels", "Ctrl+Shift+L", "play-levels", Needs::MeshAndIdle},
    Action{"apply-move", "Inspect", "Apply the move", "", "apply-move", Needs::MeshAndIdle},
    Action{"field", "Inspect", "Quality around the vertex", "Shift+Q", "field toggle", Needs::Nothing, true},
    Action{"field-in-view", "Inspect", "Quality around the vertex over the mesh", "Shift+F", "field-in-view toggle"},
    Action{"inspect-zoom", "Inspect", "Close-up of small levels", "", "inspect-zoom toggle"},
    Action{"level-range-view", "Inspect", "Heat maps in the view's colours", "", "level-range view"},
    Action{"level-range-level", "Inspect", "Heat maps over each level's range", "", "level-range level"},
    Action{"copy-level", "Inspect", "Copy the shown level as CSV", "", "copy-level", Needs::MeshAndIdle, true},

    Action{"color-by-quality", "Colours", "Quality", "", "color-by quality"},
    Action{"color-by-kind", "Colours", "Kind of element", "", "color-by kind"},
    Action{"color-by-group", "Colours", "Groups and markers", "", "color-by group", Needs::Mesh},
    Action{"color-by-valence", "Colours", "Valence", "", "color-by valence"},
    Action{"color-by-class", "Colours", "Colour classes", "", "color-by class"},
    Action{"color-by-displacement", "Colours", "Displacement", "", "color-by displacement"},
    Action{"color-by-size", "Colours", "Size", "", "color-by size"},
    Action{"color-by-deviation", "Colours", "Deviation from the input", "", "color-by deviation"},
    Action{"color-by-tilt", "Colours", "Tilt from the input", "", "color-by tilt"},
    Action{"color-by-freedom", "Colours", "Freedom to move", "", "color-by freedom"},
    Action{"color-by-multiplier", "Colours", "Multiplier, where elements hold the minimum", "", "color-by multiplier"},
    Action{"color-by-inverted", "Colours", "Only inverted elements", "", "color-by inverted"},
    Action{"color-by-difference", "Colours", "Difference", "", "color-by difference", Needs::Mesh},
    Action{"range-input", "Colours", "Range: the input's", "", "range input", Needs::Nothing, true},
    Action{"range-fixed", "Colours", "Range: 0 to 1", "", "range fixed"},
    Action{"range-auto", "Colours", "Range: the mesh's own", "", "range auto"},
    Action{"range-expanding", "Colours", "Range: growing", "", "range expanding"},
    Action{"range-percentile", "Colours", "Range: 2nd to 98th percentile", "", "range percentile 2 98"},
    Action{"next-map", "Colours", "Next colour map", "Shift+M", "colormap next"},
    Action{"reverse-colors", "Colours", "Reversed", "", "reverse-colors toggle"},
    Action{"shading", "Colours", "Light on volumes", "", "shading toggle"},
    Action{"occlusion", "Colours", "Darker corners of volumes", "", "occlusion toggle"},
    Action{"filter-off", "Colours", "No filter", "", "filter off", Needs::Nothing, true},
    Action{"others-fade", "Colours", "Other elements: faded", "", "filter-mode fade"},
    Action{"others-isolate", "Colours", "Other elements: hidden", "", "filter-mode isolate"},
    Action{"others-only-outline", "Colours", "Other elements: outlines", "", "filter-mode only-outline"},
    Action{"isolate-off", "Colours", "All categories", "", "isolate off"},
    Action{"worst-view", "Colours", "Only the 10 worst elements", "Shift+K", "worst-view toggle", Needs::Mesh, true},
    Action{"fit-worst", "Colours", "Go to the worst elements", "Ctrl+K", "fit-worst", Needs::Mesh},
    Action{"labels-off", "Colours", "Labels: none", "", "labels off", Needs::Nothing, true},
    Action{"labels-vertices", "Colours", "Labels: vertices", "", "labels vertices", Needs::Mesh},
    Action{"labels-elements", "Colours", "Labels: elements", "", "labels elements", Needs::Mesh},
    Action{"labels-both", "Colours", "Labels: both", "", "labels both", Needs::Mesh},
    Action{"labels-next", "Colours", "Next labels", "I", "labels next", Needs::Mesh},

    Action{"palette", "Help", "All commands…", "Ctrl+P", "dialog palette"},
    Action{"tour", "Help", "Tour: two minutes of guided steps", "", "tour on"},
    Action{"keys", "Help", "Keys", "F1", "dialog keys"},
    Action{"about", "Help", "About", "", "dialog about"},
};

}  // namespace

std::span<const Action> actions() { return kActions; }

const Action* find_action(std::string_view id) {
  const auto at = std::find_if(kActions.begin(), kActions.end(), [id](const Action& action) { return action.id == id; });
  return at == kActions.end() ? nullptr : &*at;
}

const Action* action_of(const KeyChord& chord) {
  // "+" is Shift+"=" on many keyboards, and a key of its own on others; key codes know only "=".
  KeyChord wanted = chord;
  if (chord.code == '=' && !chord.ctrl && !chord.alt) wanted = {'+', false, false, false};
  if (wanted == parse_key("Ctrl+Shift+Z")) wanted = *parse_key("Ctrl+Y");  // people know either
  for (const Action& action : kActions) {
    if (!action.key.empty() && parse_key(action.key) == wanted) return &action;
  }
  return nullptr;
}

std::vector<std::string_view> menu_names() {
  std::vector<std::string_view> names;
  for (const Action& action : kActions) {
    if (std::find(names.begin(), names.end(), action.menu) == names.end()) names.push_back(action.menu);
  }
  return names;
}

bool enabled(const Action& action, const Situation& now) {
  const bool ready = now.mesh && !now.busy;
  const std::array<bool, 14> met{true,  // in the order of Needs
                                 now.mesh,
                                 ready,
                                 now.busy,
                                 ready && now.runs > 1,
                                 now.picked,
                                 ready && now.selected,
                                 !now.busy && !now.undo.empty(),
                                 !now.busy && !now.redo.empty(),
                                 now.mesh && now.volume,
                                 now.mesh && !now.volume,
                                 ready && now.better,
                                 now.picked || now.leavable,
                                 ready && (now.selected || now.picked)};
  return met[static_cast<std::size_t>(action.needs)];
}

std::string title_of(const Action& action, const Situation& now) {
  const std::string& about = action.needs == Needs::Undo ? now.undo : action.needs == Needs::Redo ? now.redo : std::string();
  return about.empty() ? std::string(action.title) : std::string(action.title) + ' ' + about;
}

std::vector<std::string> search_words(std::string_view query) {
  const std::string wanted = lower_case(query);
  std::vector<std::string> words;
  for (std::size_t at = 0; at < wanted.size();) {
    const std::size_t end = std::min(wanted.find(' ', at), wanted.size());
    if (end > at) words.push_back(wanted.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

bool holds_all(std::string_view text, std::span<const std::string> words) {
  const std::string low = lower_case(text);
  return std::all_of(words.begin(), words.end(), [&](const std::string& word) { return low.find(word) != std::string::npos; });
}

std::vector<const Action*> search_actions(std::string_view query) {
  const std::vector<std::string> words = search_words(query);
  std::vector<const Action*> found;
  for (const Action& action : kActions) {
    std::string text;
    for (const std::string_view part : {action.title, action.menu, action.command, action.id}) text.append(part).append("\n");
    if (holds_all(text, words)) found.push_back(&action);
  }
  const std::string wanted = lower_case(query);
  std::stable_partition(found.begin(), found.end(), [&](const Action* action) { return lower_case(action->title).starts_with(wanted); });
  return found;
}

}  // namespace dmoscope::ui
