#include "ui/inside_commands.h"

#include "core/inside/clip_words.h"
#include "core/session/input_mesh.h"
#include "ui/command_words.h"

namespace dmoscope::ui {
namespace {

/// The box of the mesh on show.
render::Bounds3 box_of_volume(const CommandHost& host) {
  const auto view = host.session();
  if (!view || !view->input) throw UsageError("no mesh is open");
  if (!view->input->is_volume()) throw UsageError("this mesh has no inside: it is not one of volume elements");
  render::Bounds3 box;
  for (const Vec3& p : view->frame ? view->frame->positions : view->input->mesh.positions) box.include(p);
  return box;
}

float to_quality(const std::string& word) { return static_cast<float>(to_number(word)); }

void set_clip(ViewState& state, const CommandHost& host, Arguments words) {
  need(words, 1, 1);
  ClipPlane& clip = state.inside.clip;
  if (words[0] == "off") {
    clip.on = false;
  } else if (words[0] == "flip") {
    clip.flip = !clip.flip;
  } else {
    const render::Bounds3 box = box_of_volume(host);
    const ClipPlane::Mode mode = clip.mode;
    clip = parse_clip(words[0], box.low, box.high);
    clip.mode = mode;
  }
}

void add_clip_verbs(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"clip", "clip PLANE|off|flip",
             "takes away what of a volume mesh lies beyond a plane: x, y, z, -x, -y, -z, with :FRACTION of the mesh or half-way, or "
             "NX,NY,NZ:OFFSET"},
            [&state, &host](Arguments words) { set_clip(state, host, words); });
  table.add({"clip-mode", "clip-mode crinkle|cut", "whole cells stay, or they are cut through"}, [&state](Arguments words) {
    need(words, 1, 1);
    state.inside.clip.mode = parse_clip_mode(words[0]);
  });
}

void add_peel_verbs(CommandTable& table, ViewState& state) {
  InsideView& view = state.inside;
  table.add({"peel", "peel N", "takes so many layers of cells off the boundary of a volume mesh"}, [&view](Arguments words) {
    need(words, 1, 1);
    view.peel = static_cast<Index>(std::min<std::uint64_t>(to_count(words[0]), kNoIndex - 1));
  });
  table.add({"peel-quality", "peel-quality Q|off", "takes cells of a higher quality away"}, [&view](Arguments words) {
    need(words, 1, 1);
    view.peel_quality = words[0] == "off" ? std::nullopt : std::optional(to_quality(words[0]));
  });
  table.add({"keep-quality", "keep-quality LOW HIGH|off", "only cells of a quality in this range are seen"}, [&view](Arguments words) {
    if (words.size() == 1 && words[0] == "off") {
      view.isolate.reset();
      return;
    }
    need(words, 2, 2);
    const std::pair range{to_quality(words[0]), to_quality(words[1])};
    if (!(range.first <= range.second)) throw UsageError("the lower quality comes first");
    view.isolate = range;
  });
  table.add({"worst-cells", "worst-cells N|off", "only the N worst cells are seen, in a faint boundary of the rest"},
            [&view](Arguments words) {
              need(words, 1, 1);
              view.worst = words[0] == "off" ? 0 : to_count(words[0]);
              view.ghost = view.worst > 0;
            });
  table.add({"ghost-rest", "ghost-rest [on|off|toggle]", "the boundary of what was taken away is seen faintly"}, [&view](Arguments words) {
    need(words, 0, 1);
    view.ghost = switched(words, 0, view.ghost);
  });
  table.add({"shrink", "shrink FACTOR", "draws every cell of a volume mesh so large, 1 is its own size"}, [&view](Arguments words) {
    need(words, 1, 1);
    const double factor = to_number(words[0]);
    if (!(factor > 0.0 && factor <= 1.0)) throw UsageError("the factor must be greater than 0 and at most 1");
    view.shrink = factor;
  });
  table.add({"show-all", "show-all", "all cells of a volume mesh are seen again"}, [&view](Arguments words) {
    need(words, 0, 0);
    view = {};
  });
}

void add_orbit_verbs(CommandTable& table, ViewState& state) {
  table.add({"view-from", "view-from iso|+x|-x|+y|-y|+z|-z", "looks at all of a volume mesh from there"}, [&state](Arguments words) {
    need(words, 1, 1);
    state.orbit.look_from(render::view_preset_from_name(words[0]));
    state.requests.fit = true;
  });
  table.add({"turn", "turn DX DY", "turns a volume mesh as a drag of so many pixels does"}, [&state](Arguments words) {
    need(words, 2, 2);
    state.orbit.turn({to_number(words[0]), to_number(words[1])}, state.viewport);
  });
  table.add({"roll", "roll X Y TO-X TO-Y", "turns it as a ball that is dragged from one pixel to another"}, [&state](Arguments words) {
    need(words, 4, 4);
    state.orbit.roll({to_number(words[0]), to_number(words[1])}, {to_number(words[2]), to_number(words[3])}, state.viewport);
  });
  table.add({"orbit-about", "orbit-about X Y Z", "moves this point of a volume mesh to the middle, to turn about it"},
            [&state](Arguments words) {
              need(words, 3, 3);
              state.orbit.orbit_about({to_number(words[0]), to_number(words[1]), to_number(words[2])});
            });
  table.add({"perspective", "perspective [on|off|toggle]", "what is farther away looks smaller"}, [&state](Arguments words) {
    need(words, 0, 1);
    state.orbit.perspective = switched(words, 0, state.orbit.perspective);
  });
  table.add({"trackball", "trackball [on|off|toggle]", "a drag rolls a volume mesh as a ball instead of turning it upright"},
            [&state](Arguments words) {
              need(words, 0, 1);
              state.trackball = switched(words, 0, state.trackball);
            });
}

}  // namespace

void add_inside_verbs(CommandTable& table, ViewState& state, const CommandHost& host) {
  add_clip_verbs(table, state, host);
  add_peel_verbs(table, state);
  add_orbit_verbs(table, state);
}

}  // namespace dmoscope::ui
