// Common parts of all dialogs, and the small ones: find, keys, about, error.
#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/panels/panels.h"

namespace dmoscope::ui {

bool begin_dialog(PanelContext& context, const char* title, float width_em, float height_em) {
  if (!ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float em = context.em();
  const float width = std::min(width_em * em, screen.x - 2 * em);
  const float most = screen.y - 2 * em;
  ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  if (height_em > 0) {
    ImGui::SetNextWindowSize({width, std::min(height_em * em, most)});
  } else {
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, most});
  }
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(16), context.px(14)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, context.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGuiWindowFlags flags =
      ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings;
  if (height_em <= 0) flags |= ImGuiWindowFlags_AlwaysAutoResize;
  const bool open = ImGui::BeginPopupModal(title, nullptr, flags);
  ImGui::PopStyleVar(3);
  if (!open) return false;
  heading(context, title);
  ImGui::Dummy({0, context.px(2)});
  if (ImGui::IsKeyPressed(key::kEscape, false)) context.state.dialog = Dialog::None;
  return true;
}

void end_dialog() { ImGui::EndPopup(); }

namespace {

struct DialogInfo {
  Dialog dialog;
  const char* title;
  void (*draw)(PanelContext&);
};
constexpr std::array kDialogInfos{DialogInfo{Dialog::Open, "Open a mesh", draw_open_dialog},
                                  DialogInfo{Dialog::Export, "Export", draw_export_dialog},
                                  DialogInfo{Dialog::Screenshot, "Screenshot", draw_screenshot_dialog},
                                  DialogInfo{Dialog::Find, "Find vertex or element", draw_find_dialog},
                                  DialogInfo{Dialog::Palette, "All commands", draw_palette_dialog},
                                  DialogInfo{Dialog::Keys, "Keys", draw_keys_dialog},
                                  DialogInfo{Dialog::About, "About dmoscope", draw_about_dialog},
                                  DialogInfo{Dialog::Error, "Error", draw_error_dialog},
                                  DialogInfo{Dialog::Log, "Log", draw_log_dialog},
                                  DialogInfo{Dialog::Sequence, "Pictures of a run", draw_sequence_dialog},
                                  DialogInfo{Dialog::Plot, "Save the plot", draw_plot_dialog},
                                  DialogInfo{Dialog::SaveSession, "Save the session", draw_save_session_dialog},
                                  DialogInfo{Dialog::Unsaved, "Not saved", draw_unsaved_dialog},
                                  DialogInfo{Dialog::Recover, "Recover", draw_recover_dialog},
                                  DialogInfo{Dialog::Formula, "A metric of your own", draw_formula_dialog},
                                  DialogInfo{Dialog::Compare, "Compare", draw_compare_dialog}};
/// Facts of a dialog, which must not be None.
const DialogInfo& info_of(Dialog dialog) { return *std::ranges::find(kDialogInfos, dialog, &DialogInfo::dialog); }

void close_stale_popup(PanelContext& context, Dialog now) {
  Dialog& shown = context.widgets.dialog_shown;
  context.widgets.dialog_opened = shown != now;
  if (shown != now && shown != Dialog::None && ImGui::BeginPopupModal(info_of(shown).title)) {
    ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
  }
  shown = now;
}

}  // namespace

void draw_dialogs(PanelContext& context) {
  const Dialog now = context.state.dialog;
  close_stale_popup(context, now);
  if (now != Dialog::None) info_of(now).draw(context);
}

void draw_find_dialog(PanelContext& context) {
  if (!begin_dialog(context, info_of(Dialog::Find).title, 26)) return;
  WidgetState& widgets = context.widgets;
  const Frame* frame = context.frame();
  if (ImGui::RadioButton("vertex", widgets.find.kind == 0)) widgets.find.kind = 0;
  ImGui::SameLine();
  if (ImGui::RadioButton("element", widgets.find.kind == 1)) widgets.find.kind = 1;
  if (frame != nullptr) {
    const auto size = widgets.find.kind == 0 ? frame->vertex_count() : frame->element_count();
    ImGui::SameLine(0, context.px(16));
    dim_text(context, fmt::format("id from 0 to {}", size == 0 ? 0 : size - 1), false);
  }
  if (context.widgets.dialog_opened) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool entered =
      ImGui::InputText("##id", &widgets.find.text, ImGuiInputTextFlags_CharsDecimal | ImGuiInputTextFlags_EnterReturnsTrue);
  context.items.record_last("find:id");
  const bool go = ImGui::Button("Go there");
  context.items.record_last("find:go");
  ImGui::SameLine();
  close_button(context, "Cancel");
  if ((entered || go) && !widgets.find.text.empty()) {
    context.state.dialog = Dialog::None;
    context.send(fmt::format("goto {} {}", widgets.find.kind == 0 ? "vertex" : "element", widgets.find.text));
  }
  end_dialog();
}

void draw_keys_dialog(PanelContext& context) {
  if (!begin_dialog(context, info_of(Dialog::Keys).title, 52, 40)) return;
  ImGui::BeginChild("list", {0, -ImGui::GetFrameHeightWithSpacing()});
  const auto row = [&](const std::string& key, const std::string& what) {
    ImGui::TableNextColumn();
    ImGui::TextColored(colour_vector(context.palette.accent), "%s", key.c_str());
    ImGui::TableNextColumn();
    wrapped_text(what);
  };
  const auto table = [&](const char* name) {
    ImGui::Spacing();
    heading(context, name);
    const int pairs = ImGui::GetContentRegionAvail().x >= 46 * context.em() ? 2 : 1;  // with two, titles would be cut in a narrower dialog
    if (!ImGui::BeginTable(name, 2 * pairs)) return false;
    for (int k = 0; k < pairs; ++k) {
      ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 7.5F * context.em());
      ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    }
    return true;
  };
  for (const std::string_view menu : menu_names()) {
    if (!table(std::string(menu).c_str())) continue;
    for (const Action& action : actions()) {
      if (action.menu == menu && !action.key.empty()) row(std::string(action.key), std::string(action.title));
    }
    ImGui::EndTable();
  }
  if (table("Mouse on the mesh")) {
    row("click", "select the vertex there, or else the element");
    row("Alt+click", "pick the element");
    row("drag", "move the picture");
    row("wheel", "zoom to the cursor");
    row("double click", "fit");
    row("right click", "commands for what is under the pointer");
    ImGui::EndTable();
  }
  ImGui::EndChild();
  close_button(context, "Close");
  end_dialog();
}

void draw_about_dialog(PanelContext& context) {
  if (!begin_dialog(context, info_of(Dialog::About).title, 38)) return;
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(
      "See, compare and run Discrete Mesh Optimization: vertices move, topology never does, and the worst element gets as good as it can.");
  ImGui::Spacing();
  dim_text(context, "The method: D. Zint, R. Grosso. Discrete Mesh Optimization on GPU. 27th International Meshing Roundtable, 2018.");
  ImGui::Spacing();
  dim_text(context, "MIT licence. Made with Dear ImGui, GLFW, GLAD, OpenMesh, FreeType, pugixml, zlib, DejaVu fonts.");
  ImGui::Spacing();
  dim_text(context, context.activity.renderer);
  dim_text(context, std::string(name(context.activity.backend)) +
                        (context.activity.backend_reason.empty() ? "" : ": " + context.activity.backend_reason));
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  close_button(context, "Close");
  end_dialog();
}

void draw_error_dialog(PanelContext& context) {
  if (!begin_dialog(context, info_of(Dialog::Error).title, 42)) return;
  wrapped_text(context.shown(context.state.error_text));
  context.items.record_last("error:text");
  ImGui::Spacing();
  if (ImGui::Button("Copy text")) context.state.requests.clipboard = context.state.error_text;
  context.items.record_last("error:copy");
  ImGui::SameLine();
  if (context.widgets.dialog_opened) ImGui::SetKeyboardFocusHere();
  close_button(context, "Close");
  if (ImGui::IsKeyPressed(key::kEnter, false)) context.state.dialog = Dialog::None;
  end_dialog();
}

}  // namespace dmoscope::ui
