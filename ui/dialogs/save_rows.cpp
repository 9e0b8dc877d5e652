#include "ui/dialogs/save_rows.h"

#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/io/mesh_io.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

namespace fs = std::filesystem;

fs::path mesh_file(const PanelContext& context) {
  const Frame* frame = context.frame();
  return frame == nullptr ? fs::path() : frame->input->path;
}

void row_label(PanelContext& context, const SaveForm& form, const char* text) {
  ImGui::AlignTextToFramePadding();
  dim_text(context, text, false);
  ImGui::SameLine(form.label_em * context.em());
}

void go_to_folder(SaveRows& rows, const std::string& folder) {
  rows.target.folder = folder;
  // A name with a folder of its own would keep that folder.
  rows.target.name = fs::path(rows.target.name).filename().string();
  rows.target.asked.clear();
  rows.target.trouble.clear();
}

void draw_places(PanelContext& context, const SaveForm& form, float width) {
  SaveRows& rows = form.rows;
  ImGui::SetNextItemWidth(width);
  const std::string preview = fit_path(context.shown(rows.target.folder), width - 2.5F * context.em());
  const bool open = ImGui::BeginCombo("##folder", preview.c_str(), ImGuiComboFlags_HeightLarge);
  if (!open) context.items.record_last(form.items + ":folder");
  if (!open) return next_item_tooltip(context.shown(rows.target.folder) + "\nother places");
  int k = 0;
  for (const Place& place : places(mesh_file(context), context.state.recent_files)) {
    const std::string title = fmt::format("{}##{}", context.shown(place.title), place.folder);
    if (ImGui::Selectable(title.c_str(), place.folder == rows.target.folder)) go_to_folder(rows, place.folder);
    context.items.record_last(fmt::format("place:{}", k++));
    ImGui::SameLine(11 * context.em());
    dim_text(context, fit_path(context.shown(place.folder), 24 * context.em()), false);
  }
  ImGui::EndCombo();
}

void browse(PanelContext& context, const SaveForm& form) {
  ChooserTurn& chooser = context.widgets.chooser;
  if (!chooser.usable) {
    form.rows.browsing = !form.rows.browsing;
    return;
  }
  const fs::path path = form.rows.target.path();
  ChooserWish wish{true, fmt::format("Save {}", form.endings.what), form.rows.target.folder, {}, std::string(form.endings.what), {}};
  if (!path.empty()) {
    wish.folder = path.parent_path().string();
    wish.name = path.filename().string();
  }
  wish.endings = form.endings.endings;
  if (form.endings.meshes) wish.endings.clear();  // no filter: a person may type any format of meshes
  chooser.wish = std::move(wish);
  chooser.asked_by = form.dialog;
}

/// Draws the folder's files in the dialog itself: a folder is entered, a file lends its name.
void draw_browser(PanelContext& context, const SaveForm& form) {
  SaveRows& rows = form.rows;
  if (rows.listed != rows.target.folder) {
    rows.listed = rows.target.folder;
    rows.entries = list_folder(rows.listed, true, rows.list_error);
  }
  ImGui::BeginChild("browser", {0, 9 * ImGui::GetTextLineHeightWithSpacing()}, true);
  std::string entered;
  if (ImGui::Selectable("↑ up", false, ImGuiSelectableFlags_DontClosePopups)) entered = parent_folder(rows.target.folder);
  context.items.record_last(form.items + ":up");
  if (!rows.list_error.empty()) dim_text(context, rows.list_error);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(rows.entries.size()));
  while (clipper.Step()) {
    for (int k = clipper.DisplayStart; k < clipper.DisplayEnd; ++k) {
      const FolderEntry& entry = rows.entries[static_cast<std::size_t>(k)];
      ImGui::PushID(k);
      const std::string name = context.shown(entry.folder ? "▸ " + entry.name + "/" : "   " + entry.name);
      if (entry.folder) ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(context.palette.accent));
      const bool picked =
          ImGui::Selectable(name.c_str(), !entry.folder && entry.name == rows.target.name, ImGuiSelectableFlags_DontClosePopups);
      if (entry.folder) ImGui::PopStyleColor();
      context.items.record_last("entry:" + entry.name);
      if (picked && entry.folder) entered = (fs::path(rows.target.folder) / entry.name).string();
      if (picked && !entry.folder) rows.target.set_path(fs::path(rows.target.folder) / entry.name);
      ImGui::PopID();
    }
  }
  ImGui::EndChild();
  if (!entered.empty()) go_to_folder(rows, entered);
}

}  // namespace

std::string fit_path(const std::string& path, float width) {
  if (ImGui::CalcTextSize(path.c_str()).x <= width) return path;
  std::string rest = path;
  while (!rest.empty()) {
    const std::size_t slash = rest.find('/', 1);
    if (slash == std::string::npos) break;
    rest.erase(0, slash);
    if (ImGui::CalcTextSize(("…" + rest).c_str()).x <= width) return "…" + rest;
  }
  return fit_text(rest, width);
}

bool path_field(PanelContext& context, const char* label, std::string& text) {
  std::string shown = context.shown(text);
  const std::string before = shown;
  const bool entered = ImGui::InputText(label, &shown, ImGuiInputTextFlags_EnterReturnsTrue);
  if (shown != before) {
    text = context.widgets.glyphs.meant(shown);
    (void)context.shown(text);  // registers letters that were pasted
  }
  return entered;
}

std::string name_beside(const PanelContext& context, const std::string& add, const std::string& ending) {
  const Frame* frame = context.frame();
  if (frame == nullptr) return "dmoscope" + add + ending;
  const fs::path file = frame->input->path;
  const std::string own = file.extension().string();
  const std::string stem = file.empty() ? fs::path(frame->input->mesh.name).stem().string() : file.stem().string();
  return stem + add + (!ending.empty() ? ending : own.empty() ? ".vtk" : own);
}

void begin_save(PanelContext& context, SaveRows& rows, const std::string& name) {
  const Frame* frame = context.frame();
  const std::string mesh = frame == nullptr ? std::string() : frame->input->path.string() + '\n' + frame->input->mesh.name;
  rows.browsing = false;
  rows.listed.clear();
  rows.target.asked.clear();
  rows.target.trouble.clear();
  rows.target.replaced.clear();
  if (!rows.target.name.empty() && rows.mesh == mesh) return;
  rows.mesh = mesh;
  rows.target.folder = first_folder(mesh_file(context));
  rows.target.name = name;
}

bool draw_save_rows(PanelContext& context, const SaveForm& form) {
  SaveRows& rows = form.rows;
  const bool choosing = context.widgets.chooser.open;
  row_label(context, form, "folder");
  const char* browse_label = choosing ? "Choosing…" : rows.browsing ? "Hide files" : "Browse…";
  const float button = ImGui::CalcTextSize(browse_label).x + 2 * ImGui::GetStyle().FramePadding.x;
  draw_places(context, form, ImGui::GetContentRegionAvail().x - button - context.px(6));
  ImGui::SameLine(0, context.px(6));
  ImGui::BeginDisabled(choosing);
  if (ImGui::Button(fmt::format("{}###browse", browse_label).c_str())) browse(context, form);
  context.items.record_last(form.items + ":browse");
  ImGui::EndDisabled();
  row_label(context, form, "file");
  ImGui::SetNextItemWidth(-1);
  if (context.widgets.dialog_opened || ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  const std::string before = rows.target.name;
  const bool entered = path_field(context, fmt::format("##file{}", rows.taken).c_str(), rows.target.name);
  context.items.record_last(form.items + ":file");
  if (before != rows.target.name) {
    rows.target.asked.clear();
    rows.target.trouble.clear();
  }
  if (const fs::path path = rows.target.path(); !path.empty() && path.parent_path() != rows.target.folder) {
    ImGui::Dummy({0, 0});
    ImGui::SameLine(form.label_em * context.em());
    dim_text(context, "in " + fit_path(context.shown(path.parent_path().string()), ImGui::GetContentRegionAvail().x - 2 * context.em()),
             false);
  }
  if (rows.browsing) draw_browser(context, form);
  return entered;
}

bool draw_save_buttons(PanelContext& context, const SaveForm& form, const char* verb, bool entered) {
  SaveTarget& target = form.rows.target;
  if (!target.trouble.empty()) {
    wrapped_text(context.shown(target.trouble), context.palette.error);
  }
  const bool asks = !target.asked.empty();
  if (asks) {
    wrapped_text(context.shown(fs::path(target.asked).filename().string()) + " exists already. Replace it?", context.palette.warning);
  }
  ImGui::Spacing();
  // While the question is open, Enter and the usual button do nothing: only a button of its own, which Enter does not press, replaces a
  // file.
  ImGui::BeginDisabled(asks);
  bool go = ImGui::Button(verb) || entered;
  context.items.record_last(form.items + ":go");
  ImGui::EndDisabled();
  if (asks) {
    ImGui::SameLine();
    if (ImGui::Button("Replace the file")) {
      target.replaced = target.asked;
      go = true;
    }
    context.items.record_last(form.items + ":replace");
  }
  ImGui::SameLine();
  close_button(context, "Cancel");
  if (!go || judge(target, form.endings) != SaveVerdict::Ready) return false;
  target.replaced.clear();
  target.asked.clear();
  context.state.dialog = Dialog::None;
  return true;
}

}  // namespace dmoscope::ui
