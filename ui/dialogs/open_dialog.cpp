// The program's own file browser, so that it depends on no desktop.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "core/commands/commands.h"
#include "ui/dialogs/save_rows.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

namespace fs = std::filesystem;

void enter_folder(WidgetState& widgets, const fs::path& folder) {
  std::error_code ignored;
  fs::path whole = fs::absolute(folder, ignored).lexically_normal();
  if (!whole.has_filename() && whole.has_parent_path() && whole != whole.root_path()) whole = whole.parent_path();
  widgets.open.folder = whole.string();
  widgets.open.text = widgets.open.folder;
  widgets.open.selected = -1;
  widgets.open.marked.clear();
  widgets.open.entries = list_folder(whole, widgets.open.all_files, widgets.open.error);
}

void open_files(PanelContext& context, const std::vector<fs::path>& files) {
  context.state.dialog = Dialog::None;
  for (const std::string& command : commands_to_open(context.state.open_for, files)) context.send(command);
}
void open_file(PanelContext& context, const fs::path& file) { open_files(context, {file}); }

/// Chooses a file: a click with Ctrl adds it or takes it away, with Shift it adds all files up to there; any other click chooses it alone.
/// Folders cannot be chosen.
void choose(OpenDialog& open, int row, bool several) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto name_of = [&](int k) -> const FolderEntry& { return open.entries[static_cast<std::size_t>(k)]; };
  if (several && io.KeyCtrl && !name_of(row).folder) {
    if (open.marked.empty() && open.selected >= 0 && open.selected != row && !name_of(open.selected).folder)
      open.marked.insert(name_of(open.selected).name);
    if (!open.marked.insert(name_of(row).name).second) open.marked.erase(name_of(row).name);
  } else if (several && io.KeyShift && open.selected >= 0) {
    for (int k = std::min(open.selected, row); k <= std::max(open.selected, row); ++k)
      if (!name_of(k).folder) open.marked.insert(name_of(k).name);
  } else {
    open.marked.clear();
  }
  open.selected = row;
  if (!name_of(row).folder) open.text = (fs::path(open.folder) / name_of(row).name).string();
}

/// Enters a folder or opens a file; anything else gives a message.
void go_to(PanelContext& context, const fs::path& named) {
  std::error_code ignored;
  SaveTarget target;
  target.folder = context.widgets.open.folder;
  target.name = named.string();
  const fs::path path = target.path();
  if (fs::is_directory(path, ignored)) {
    enter_folder(context.widgets, path);
  } else if (fs::exists(path, ignored)) {
    open_file(context, path);
  } else {
    context.widgets.open.error = path.string() + ": there is no such file or folder";
  }
}

void draw_entries(PanelContext& context) {
  WidgetState& widgets = context.widgets;
  const int size = static_cast<int>(widgets.open.entries.size());
  int chosen = -1;
  bool scroll = false;
  if (!ImGui::GetIO().WantTextInput) {
    const int before = widgets.open.selected;
    if (ImGui::IsKeyPressed(key::kDown)) widgets.open.selected = std::min(widgets.open.selected + 1, size - 1);
    if (ImGui::IsKeyPressed(key::kUp)) widgets.open.selected = std::max(widgets.open.selected - 1, 0);
    scroll = before != widgets.open.selected;
    if (ImGui::IsKeyPressed(key::kEnter, false) && widgets.open.selected >= 0) chosen = widgets.open.selected;
    if (ImGui::IsKeyPressed(key::kBackspace, false)) {
      enter_folder(widgets, parent_folder(widgets.open.folder));
      return;
    }
  }
  ImGuiListClipper clipper;
  clipper.Begin(size);
  if (scroll && widgets.open.selected >= 0) clipper.ForceDisplayRangeByIndices(widgets.open.selected, widgets.open.selected + 1);
  while (clipper.Step()) {
    for (int k = clipper.DisplayStart; k < clipper.DisplayEnd; ++k) {
      const FolderEntry& entry = widgets.open.entries[static_cast<std::size_t>(k)];
      ImGui::PushID(k);
      const ImVec2 at = ImGui::GetCursorScreenPos();
      const float width = ImGui::GetContentRegionAvail().x;
      constexpr ImGuiSelectableFlags kFlags = ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups;
      const bool marked = widgets.open.marked.empty() ? k == widgets.open.selected : widgets.open.marked.contains(entry.name);
      if (ImGui::Selectable("##entry", marked, kFlags)) {
        const bool alone = !ImGui::GetIO().KeyCtrl && !ImGui::GetIO().KeyShift;
        if (alone && (entry.folder || ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))) chosen = k;
        choose(widgets.open, k, context.state.open_for != OpenFor::Surface);
      }
      context.items.record_last("entry:" + entry.name);
      if (scroll && k == widgets.open.selected) ImGui::SetScrollHereY();
      ImDrawList& list = *ImGui::GetWindowDrawList();
      const std::string name = context.shown(entry.folder ? "▸ " + entry.name + "/" : "   " + entry.name);
      list.AddText(at, colour(entry.folder ? context.palette.accent : context.palette.text),
                   fit_text(name, width - 7 * context.em()).c_str());
      if (!entry.folder) {
        const std::string bytes = byte_size(entry.bytes);
        list.AddText({at.x + width - ImGui::CalcTextSize(bytes.c_str()).x - context.px(8), at.y}, colour(context.palette.dim),
                     bytes.c_str());
      }
      ImGui::PopID();
    }
  }
  if (size == 0 && widgets.open.error.empty()) {
    dim_text(context, widgets.open.all_files ? "an empty folder" : "no meshes here; \"all files\" shows the other files");
  }
  if (chosen >= 0) go_to(context, fs::path(widgets.open.folder) / widgets.open.entries[static_cast<std::size_t>(chosen)].name);
}

void draw_places_column(PanelContext& context) {
  heading(context, "Places");
  const Frame* frame = context.frame();
  const fs::path mesh = frame == nullptr ? fs::path() : frame->input->path;
  constexpr std::size_t kMost = 8;
  const std::vector<Place> all = places(mesh, context.state.recent_files);
  for (std::size_t k = 0; k < std::min(all.size(), kMost); ++k) {
    ImGui::PushID(static_cast<int>(k));
    const std::string title = fit_text(context.shown(all[k].title), ImGui::GetContentRegionAvail().x);
    if (ImGui::Selectable(title.c_str(), all[k].folder == context.widgets.open.folder, ImGuiSelectableFlags_DontClosePopups))
      enter_folder(context.widgets, all[k].folder);
    note_item(context, fmt::format("place:{}", k), context.shown(all[k].folder));
    ImGui::PopID();
  }
  ImGui::Spacing();
}

/// Starts in the last folder if the open mesh is still the same, else in the folder of the open mesh.
void begin_open(PanelContext& context) {
  OpenDialog& open = context.widgets.open;
  const Frame* frame = context.frame();
  const std::string mesh = frame == nullptr ? std::string() : frame->input->path.string();
  std::error_code ignored;
  const bool known = !open.folder.empty() && open.mesh == mesh && fs::is_directory(open.folder, ignored);
  open.mesh = mesh;
  enter_folder(context.widgets, known ? fs::path(open.folder) : fs::path(first_folder(mesh)));
}

void draw_recent_column(PanelContext& context) {
  heading(context, "Recent");
  if (context.state.recent_files.empty()) dim_text(context, "nothing yet");
  const std::vector<std::string> names = short_names(context.state.recent_files);
  std::size_t at = 0;
  for (const RecentFile& file : context.widgets.recent.list(context.state.recent_files, context.now)) {
    ImGui::PushID(file.path.c_str());
    const std::string name = context.shown(names[at++]);
    const ImGuiSelectableFlags flags = file.missing ? ImGuiSelectableFlags_Disabled : 0;
    if (ImGui::Selectable(fit_text(name, ImGui::GetContentRegionAvail().x).c_str(), false, flags)) open_file(context, file.path);
    next_item_tooltip(context.shown(file.missing ? file.reason() : file.path));
    ImGui::PopID();
  }
}

}  // namespace

void draw_open_dialog(PanelContext& context) {
  if (!begin_dialog(context, title_to_open(context.state.open_for), 56, 36)) return;
  WidgetState& widgets = context.widgets;
  if (widgets.dialog_opened) begin_open(context);
  if (ImGui::Button("↑ up")) enter_folder(widgets, parent_folder(widgets.open.folder));
  note_item(context, "open:up", "the folder above   Backspace");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  if (widgets.dialog_opened) ImGui::SetKeyboardFocusHere();  // a name can be typed at once
  const bool entered = path_field(context, "##path", widgets.open.text);
  context.items.record_last("open:path");
  if (!widgets.open.error.empty()) {
    wrapped_text(context.shown(widgets.open.error), context.palette.error);
  }
  const float bottom = ImGui::GetFrameHeightWithSpacing() + context.px(4);
  const float recent = 13 * context.em();
  ImGui::BeginChild("recent", {recent, -bottom});
  draw_places_column(context);
  draw_recent_column(context);
  ImGui::EndChild();
  ImGui::SameLine(0, context.px(16));
  ImGui::BeginChild("entries", {0, -bottom});
  draw_entries(context);
  ImGui::EndChild();

  const std::size_t marked = widgets.open.marked.size();
  const bool open = ImGui::Button(marked > 1 ? fmt::format("Open {} files###open", marked).c_str() : "Open###open");
  context.items.record_last("open:open");
  ImGui::SameLine();
  close_button(context, "Cancel");
  ImGui::SameLine(0, context.px(24));
  if (ImGui::Checkbox("all files", &widgets.open.all_files)) enter_folder(widgets, widgets.open.folder);
  context.items.record_last("open:all");
  if ((entered || open) && marked > 1) {
    std::vector<fs::path> files;
    for (const std::string& name : widgets.open.marked) files.push_back(fs::path(widgets.open.folder) / name);
    open_files(context, files);
  } else if ((entered || open) && !widgets.open.text.empty()) {
    go_to(context, widgets.open.text);
  }
  end_dialog();
}

}  // namespace dmoscope::ui
