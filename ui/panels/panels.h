#pragma once
// The parts of the window. Each reads the context and sends command lines; none changes the session, none calls OpenGL.

#include "core/reference/kinds.h"
#include "ui/panels/panel_context.h"
#include "ui/panels/widgets.h"

namespace dmoscope::ui {

/// How wide menus and tools are in one row.
[[nodiscard]] HeaderSize header_size(const PanelContext& context);
void draw_menu(PanelContext& context, const Rect& rect);
void draw_toolbar(PanelContext& context, const Rect& rect);
void draw_runs(PanelContext& context);
void draw_parameters(PanelContext& context);
/// Of the active run, as a part of its parameters: a second phase, and a second aim.
void draw_composite(PanelContext& context, const RunView& run);
void draw_colours(PanelContext& context);
/// The mesh's groups; nothing of a mesh without any.
void draw_groups(PanelContext& context);
/// The boundary loops of a planar or surface mesh; and where on its loop a vertex is, with buttons that walk along it.
void draw_loops(PanelContext& context);
void draw_loop_place(PanelContext& context, const Frame& frame, Index vertex);
/// What is seen of a volume mesh, and from where; nothing of another one.
void draw_clipping(PanelContext& context);
/// To be called with the mouse over the mesh: after a while its element's value is shown.
void handle_rest(PanelContext& context, const PaneFacts& pane, Vec2<double> at);
/// The axes' letters in a viewport, which look along them; to be called before what lies below.
void handle_axes(PanelContext& context, const PaneFacts& pane);
/// The clip plane in a viewport: what of it takes the mouse, to be called before whatever lies below it; and its picture.
void handle_clip_plane(PanelContext& context, const PaneFacts& pane);
void draw_clip_plane(const PanelContext& context, const PaneFacts& pane);
/// A column's docks. `overlay`: over the mesh, in a small window.
void draw_column(PanelContext& context, Side side, const Rect& rect, bool overlay);
/// Facts of the mesh and its quality; of what is picked.
void draw_mesh_facts(PanelContext& context);
void draw_selection(PanelContext& context);
/// Of a picked vertex, and of the edges of a picked element, where the run's vertices slide: their kinds, and what changes them.
void draw_vertex_kind(PanelContext& context, const Frame& frame, const RunView& run, Index vertex);
void draw_element_edges(PanelContext& context, const Frame& frame, const RunView& run, Index element);
/// The same as entries of a viewport's menu, for what is under the mouse; kNoIndex: nothing is. True: there are some.
bool draw_kind_entries(PanelContext& context, const Frame& frame, const RunView& run, Index vertex, EdgeEnds edge);
/// The edge of an element that is nearest to a point.
[[nodiscard]] EdgeEnds nearest_edge(const Frame& frame, Index element, Vec3 at);
void draw_worst(PanelContext& context);
void draw_inspection(PanelContext& context);
/// The quality around the inspected vertex over the mesh, when it is wanted, and over it the marks that it covers.
void draw_field_in_view(PanelContext& context, const PaneFacts& pane);
void draw_viewports(PanelContext& context, const Rect& rect);
/// What a viewport among several shows, in its upper left corner: what of it takes the mouse, to be called before whatever lies below it;
/// and its picture.
void handle_pane_title(PanelContext& context, const PaneFacts& pane);
void draw_pane_title(PanelContext& context, const PaneFacts& pane);
/// Entries that choose what a viewport shows.
void draw_pane_entries(PanelContext& context, const PaneFacts& pane);
/// The brush under the mouse over the mesh's item, drawn last; `at`: the mouse in the viewport. True: dragging is the brush's.
bool handle_brush(PanelContext& context, const PaneFacts& pane, Vec2<double> at);
/// The colour bar, or the legend of categories, in the lower left corner: what of it takes the mouse, to be called before whatever lies
/// below it; and its picture.
void handle_colour_bar(PanelContext& context, const Rect& rect);
void draw_colour_bar(PanelContext& context, const Rect& rect);
/// With the space around it.
[[nodiscard]] float colour_bar_height(const PanelContext& context, const Rect& rect);
/// The ids on the mesh.
void draw_labels(PanelContext& context, const PaneFacts& pane);
/// Over the meshes: what is to be said of the run that has come to its end, if anything.
void draw_notice(PanelContext& context, const Rect& rect);
/// The tour's card, or the offer of a tour, over all panels; last of these, since it looks for the control that it is about.
void draw_tour(PanelContext& context, const Layout& layout);
void draw_start_page(PanelContext& context, const Rect& rect);
/// Where the timeline's groove lies, in pixels across the window; the plot above it, if it is over iterations, has its inside there, too.
struct TimelineRoom {
  float left = 0, right = 0;
  bool labelled = true;  // with the iteration at its right
  bool below_plot = false;
};
[[nodiscard]] TimelineRoom timeline_room(const PanelContext& context, const Layout& layout);
void draw_plots(PanelContext& context, const Layout& layout);
void draw_timeline(PanelContext& context, const Layout& layout);
void draw_status(PanelContext& context, const Rect& rect);
/// Over the mesh: a message that the status has no room for.
void draw_message(PanelContext& context, const Rect& viewport);
void draw_strips(PanelContext& context, const Layout& layout);
void draw_splitters(PanelContext& context, const Layout& layout);

/// An edge that resizes what lies beside it when it is dragged; a double click gives it its usual size.
struct SplitterEdge {
  const char* panel;     // of the command panel-size
  Rect rect;             // what takes the mouse
  bool upright;          // it is dragged sideways
  double direction;      // +1 where dragging right or down grows it, else -1
  double Panels::*size;  // in em
  double least, most;
};
/// The same within a window that is being drawn.
void splitter_grip(PanelContext& context, const SplitterEdge& edge);

}  // namespace dmoscope::ui
