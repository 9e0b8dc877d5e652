#pragma once
// Parts of the window. Each reads the context and sends command lines; none changes the session, none calls OpenGL.

#include "core/reference/kinds.h"
#include "ui/panels/panel_context.h"
#include "ui/panels/widgets.h"
#include "ui/plots/plot.h"
#include "ui/toolkit/file_browser.h"

namespace dmoscope::ui {

/// Widths of menus and tools in one row.
[[nodiscard]] HeaderSize header_size(const PanelContext& context);
void draw_menu(PanelContext& context, const Rect& rect);
void draw_toolbar(PanelContext& context, const Rect& rect);
void draw_runs(PanelContext& context);
void draw_parameters(PanelContext& context);
void draw_colours(PanelContext& context);
/// Draws the mesh's groups; nothing for a mesh without any.
void draw_groups(PanelContext& context);
/// Draws the boundary loops of a planar or surface mesh; and a vertex's place on its loop, with buttons that walk along it.
void draw_loops(PanelContext& context);
void draw_loop_place(PanelContext& context, const Frame& frame, Index vertex);
/// Draws the choice of the visible part of a volume mesh, and of the direction of view; nothing for other meshes.
void draw_clipping(PanelContext& context);
/// Handles the mouse over the mesh: after a while its element's value is shown.
void handle_rest(PanelContext& context, const PaneFacts& pane, Vec2<double> at);
/// Handles the axes' letters in a viewport: a click looks along the axis. To be called before everything that lies below them.
void handle_axes(PanelContext& context, const PaneFacts& pane);
/// Handles the clip plane's mouse input in a viewport, to be called before everything that lies below it; and draws it.
void handle_clip_plane(PanelContext& context, const PaneFacts& pane);
void draw_clip_plane(const PanelContext& context, const PaneFacts& pane);
/// Draws a column's docks. `overlay`: over the mesh, in a small window.
void draw_column(PanelContext& context, Side side, const Rect& rect, bool overlay);
/// Draws facts of the mesh and its quality; then those of the pick.
void draw_mesh_facts(PanelContext& context);
void draw_selection(PanelContext& context);
/// Draws the kinds of a picked vertex, and of the edges of a picked element, where the run's vertices slide, with controls that change
/// them.
void draw_vertex_kind(PanelContext& context, const Frame& frame, const RunView& run, Index vertex);
void draw_element_edges(PanelContext& context, const Frame& frame, const RunView& run, Index element);
/// Draws the kinds as entries of a viewport's menu, for vertex and element under the mouse (kNoIndex: none). True if there are entries.
bool draw_kind_entries(PanelContext& context, const Frame& frame, const RunView& run, Index vertex, EdgeEnds edge);
/// The edge of an element that is nearest to a point.
[[nodiscard]] EdgeEnds nearest_edge(const Frame& frame, Index element, Vec3 at);
void draw_worst(PanelContext& context);
void draw_inspection(PanelContext& context);
/// Draws the quality around the inspected vertex over the mesh, when it is wanted, and over it the marks that it covers.
void draw_field_in_view(PanelContext& context, const PaneFacts& pane);
void draw_viewports(PanelContext& context, const Rect& rect);
/// Handles the mouse input of a viewport's title in its upper left corner, to be called before everything that lies below it; and draws it,
/// and returns its place.
void handle_pane_title(PanelContext& context, const PaneFacts& pane);
Rect draw_pane_title(PanelContext& context, const PaneFacts& pane);
/// Width in pixels that the title and a note beside it may take.
[[nodiscard]] float title_room(const PanelContext& context, const PaneFacts& pane);
/// Draws the buttons in the active viewport's upper right corner, to be called before everything that lies below them.
void draw_viewport_tools(PanelContext& context, const PaneFacts& pane);
/// Draws the entries that choose the content of a viewport.
void draw_pane_entries(PanelContext& context, const PaneFacts& pane);
/// Handles and draws the brush under the mouse over the mesh's item, drawn last; `at`: the mouse in the viewport. True: drags belong to the
/// brush.
bool handle_brush(PanelContext& context, const PaneFacts& pane, Vec2<double> at);
/// Handles the mouse input of the colour bar, or of the legend of categories, in the lower left corner, to be called before everything that
/// lies below it; and draws it.
void handle_colour_bar(PanelContext& context, const Rect& rect);
void draw_colour_bar(PanelContext& context, const Rect& rect);
/// Height in pixels, with the space around it.
[[nodiscard]] float colour_bar_height(const PanelContext& context, const Rect& rect);
/// Draws name and quality of the picked element, with a line to it; and the ids on the mesh.
void draw_pick_label(PanelContext& context, const PaneFacts& pane);
void draw_labels(PanelContext& context, const PaneFacts& pane);
/// Draws the note about a run that has come to its end, if there is one, above the meshes, and takes its room from them.
void draw_notice(PanelContext& context, Layout& layout);
/// Draws the tour's card, or the offer of a tour, over all panels; to be called last, because it looks for the control that it points to.
void draw_tour(PanelContext& context, const Layout& layout);
void draw_start_page(PanelContext& context, const Rect& rect);
/// Interval of the timeline's groove, in pixels across the window; a plot over iterations above it has its inside there, too.
struct TimelineRoom {
  float left = 0, right = 0;
  bool labelled = true;  // whether the iteration stands at its right
  bool below_plot = false;
};
[[nodiscard]] TimelineRoom timeline_room(const PanelContext& context, const Layout& layout);
/// Draws the plots, or in their place the tables of runs: by the shown metric, and by every metric that one of them optimises.
void draw_plots(PanelContext& context, const Layout& layout);
void draw_run_table(PanelContext& context);
void draw_comparison(PanelContext& context);
/// Draws the plot in the remaining space; a click in it shows that iteration. `inside`: see PlotArea.
void draw_plot_area(PanelContext& context, std::optional<Range> inside = {});
void draw_timeline(PanelContext& context, const Layout& layout);
/// Gives a message that must be read whole as much of the lowest row as it needs.
void give_message_room(PanelContext& context, Layout& layout);
void draw_status(PanelContext& context, const Layout& layout);
void draw_splitters(PanelContext& context, const Layout& layout);

/// An edge that resizes the panel beside it when dragged; a double click restores the usual size.
struct SplitterEdge {
  const char* panel;     // panel of the command panel-size
  Rect rect;             // area that takes the mouse
  bool upright;          // whether it is dragged sideways
  double direction;      // member of Panels with the size, in em
  double Panels::*size;  // in em
  double least, most;
};
/// Handles and draws such an edge within a window that is being drawn.
void splitter_grip(PanelContext& context, const SplitterEdge& edge);

/// Draws the page in the start page's place while the first file is read: its name, progress, and Cancel.
void draw_reading_page(PanelContext& context, const Rect& rect, const BeingRead& reading);
/// Draws a line in the middle of a viewport without a picture, `row` lines below the exact middle.
void draw_centred(const PanelContext& context, const Rect& rect, const std::string& words, float row);

}  // namespace dmoscope::ui
