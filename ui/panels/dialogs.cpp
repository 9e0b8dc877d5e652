// What all dialogs share, and the small ones: find, keys, about, error.
#include <algorithm>

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

void close_button(PanelContext& context, const char* label = "Close") {
  if (ImGui::Button(label)) context.state.dialog = Dialog::None;
  context.items.record_last("dialog:close");
}

const char* dialog_title(Dialog dialog) {
  switch (dialog) {
    case Dialog::Open:
      return "Open a mesh";
    case Dialog::Export:
      return "Export";
    case Dialog::Screenshot:
      return "Screenshot";
    case Dialog::Find:
      return "Find vertex or element";
    case Dialog::Palette:
      return "All commands";
    case Dialog::Keys:
      return "Keys";
    case Dialog::About:
      return "About dmoscope";
    case Dialog::Error:
      return "That did not work";
    case Dialog::Log:
      return "Log";
    case Dialog::Sequence:
      return "Pictures of a run";
    case Dialog::Plot:
      return "Save the plot";
    case Dialog::SaveSession:
      return "Save the session";
    case Dialog::Unsaved:
      return "Not saved";
    case Dialog::Recover:
      return "Recover";
    case Dialog::Formula:
      return "A metric of your own";
    case Dialog::None:
      break;
  }
  return "";
}

void close_stale_popup(PanelContext& context, Dialog now) {
  Dialog& shown = context.widgets.dialog_shown;
  context.widgets.dialog_opened = shown != now;
  if (shown != now && shown != Dialog::None && ImGui::BeginPopupModal(dialog_title(shown))) {
    ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
  }
  shown = now;
}

}  // namespace

void draw_dialogs(PanelContext& context) {
  const Dialog now = context.state.dialog;
  close_stale_popup(context, now);
  switch (now) {
    case Dialog::None:
      break;
    case Dialog::Open:
      draw_open_dialog(context);
      break;
    case Dialog::Export:
      draw_export_dialog(context);
      break;
    case Dialog::Screenshot:
      draw_screenshot_dialog(context);
      break;
    case Dialog::Find:
      draw_find_dialog(context);
      break;
    case Dialog::Palette:
      draw_palette_dialog(context);
      break;
    case Dialog::Keys:
      draw_keys_dialog(context);
      break;
    case Dialog::About:
      draw_about_dialog(context);
      break;
    case Dialog::Error:
      draw_error_dialog(context);
      break;
    case Dialog::Log:
      draw_log_dialog(context);
      break;
    case Dialog::Sequence:
      draw_sequence_dialog(context);
      break;
    case Dialog::Plot:
      draw_plot_dialog(context);
      break;
    case Dialog::SaveSession:
      draw_save_session_dialog(context);
      break;
    case Dialog::Unsaved:
      draw_unsaved_dialog(context);
      break;
    case Dialog::Formula:
      draw_formula_dialog(context);
      break;
    case Dialog::Recover:
      draw_recover_dialog(context);
      break;
  }
}

void draw_find_dialog(PanelContext& context) {
  if (!begin_dialog(context, dialog_title(Dialog::Find), 26)) return;
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
  if (!begin_dialog(context, dialog_title(Dialog::Keys), 52, 40)) return;
  ImGui::BeginChild("list", {0, -ImGui::GetFrameHeightWithSpacing()});
  const auto row = [&](const std::string& key, const std::string& what) {
    ImGui::TableNextColumn();
    ImGui::TextColored(colour_vector(context.palette.accent), "%s", key.c_str());
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(what.c_str());
    ImGui::PopTextWrapPos();
  };
  const auto table = [&](const char* name) {
    ImGui::Spacing();
    heading(context, name);
    const int pairs = ImGui::GetContentRegionAvail().x >= 46 * context.em() ? 2 : 1;  // else titles would be cut
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
    row("click", "pick the vertex there, else the element");
    row("Alt+click", "pick the element");
    row("drag", "move the picture");
    row("wheel", "zoom to the cursor");
    row("double click", "fit");
    row("right click", "commands for what is there");
    ImGui::EndTable();
  }
  ImGui::EndChild();
  close_button(context);
  end_dialog();
}

void draw_about_dialog(PanelContext& context) {
  if (!begin_dialog(context, dialog_title(Dialog::About), 38)) return;
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
  close_button(context);
  end_dialog();
}

void draw_error_dialog(PanelContext& context) {
  if (!begin_dialog(context, dialog_title(Dialog::Error), 42)) return;
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(context.shown(context.state.error_text).c_str());
  ImGui::PopTextWrapPos();
  context.items.record_last("error:text");
  ImGui::Spacing();
  if (ImGui::Button("Copy text")) context.state.requests.clipboard = context.state.error_text;
  context.items.record_last("error:copy");
  ImGui::SameLine();
  if (context.widgets.dialog_opened) ImGui::SetKeyboardFocusHere();
  close_button(context);
  if (ImGui::IsKeyPressed(key::kEnter, false)) context.state.dialog = Dialog::None;
  end_dialog();
}

}  // namespace dmoscope::ui
