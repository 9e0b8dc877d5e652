#include "ui/toolkit/theme.h"

#include <algorithm>
#include <cmath>

namespace dmoscope::ui {
namespace {

constexpr Palette kDark{{0x1b, 0x1e, 0x23},
                        {0x23, 0x27, 0x2e},
                        {0x2f, 0x35, 0x3e},
                        {0x39, 0x40, 0x4a},
                        {0xe8, 0xeb, 0xef},
                        {0xaa, 0xb4, 0xc0},
                        {0x5f, 0xb0, 0xf7},
                        {0x0d, 0x15, 0x1d},
                        {0x72, 0xd0, 0x96},
                        {0xf2, 0xbd, 0x5c},
                        {0xff, 0x85, 0x85},
                        {0x33, 0x39, 0x42},
                        {{{0x5f, 0xb0, 0xf7},
                          {0xf5, 0xa3, 0x45},
                          {0x5c, 0xcf, 0xa6},
                          {0xe7, 0x8b, 0xc4},
                          {0xd6, 0xcb, 0x5a},
                          {0xa0, 0x9b, 0xf8},
                          {0xf0, 0x80, 0x70},
                          {0x9f, 0xb4, 0xc0},
                          {0x69, 0x87, 0x3c},
                          {0xa5, 0x69, 0x96},
                          {0x4b, 0x78, 0xe1},
                          {0xb4, 0x5a, 0xe1},
                          {0x5a, 0xb4, 0x3c},
                          {0x3c, 0x96, 0xa5},
                          {0xe1, 0x3c, 0x69},
                          {0x3c, 0xe1, 0x5a}}}};
constexpr Palette kLight{{0xf4, 0xf5, 0xf7},
                         {0xff, 0xff, 0xff},
                         {0xe9, 0xec, 0xf0},
                         {0xd3, 0xd8, 0xdf},
                         {0x1c, 0x20, 0x26},
                         {0x55, 0x5f, 0x6b},
                         {0x15, 0x5f, 0xb8},
                         {0xff, 0xff, 0xff},
                         {0x1c, 0x74, 0x3c},
                         {0x8a, 0x56, 0x00},
                         {0xb9, 0x1c, 0x2a},
                         {0xe4, 0xe7, 0xec},
                         {{{0x15, 0x5f, 0xb8},
                           {0xb3, 0x55, 0x00},
                           {0x0b, 0x7a, 0x55},
                           {0xa8, 0x2a, 0x77},
                           {0x75, 0x68, 0x00},
                           {0x5b, 0x4b, 0xc4},
                           {0xb0, 0x3a, 0x2e},
                           {0x4a, 0x60, 0x6e},
                           {0x2d, 0x0f, 0x87},
                           {0x69, 0x0f, 0x4b},
                           {0x2d, 0x4b, 0x0f},
                           {0x96, 0x78, 0x87},
                           {0x1e, 0x87, 0xb4},
                           {0x1e, 0x3c, 0x5a},
                           {0x78, 0x0f, 0x96},
                           {0x78, 0x2d, 0x0f}}}};
constexpr Palette kContrast{{0x00, 0x00, 0x00},
                            {0x00, 0x00, 0x00},
                            {0x24, 0x24, 0x24},
                            {0xb0, 0xb0, 0xb0},
                            {0xff, 0xff, 0xff},
                            {0xe2, 0xe2, 0xe2},
                            {0xff, 0xd8, 0x1a},
                            {0x00, 0x00, 0x00},
                            {0x6c, 0xff, 0x9c},
                            {0xff, 0xc4, 0x4d},
                            {0xff, 0x8a, 0x8a},
                            {0x50, 0x50, 0x50},
                            {{{0xff, 0xd8, 0x1a},
                              {0x5f, 0xc8, 0xff},
                              {0x6c, 0xff, 0x9c},
                              {0xff, 0x9a, 0xe0},
                              {0xff, 0xa0, 0x50},
                              {0xc0, 0xb8, 0xff},
                              {0xff, 0x8a, 0x8a},
                              {0xff, 0xff, 0xff},
                              {0x3c, 0x78, 0x5a},
                              {0x3c, 0x5a, 0xff},
                              {0xc3, 0x3c, 0x87},
                              {0x5a, 0xb4, 0x3c},
                              {0x78, 0x87, 0xc3},
                              {0xb4, 0x78, 0x4b},
                              {0xa5, 0x3c, 0xd2},
                              {0xa5, 0xc3, 0xa5}}}};

double luminance(render::Rgb c) {
  const auto linear = [](std::uint8_t channel) {
    const double s = channel / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}

render::Rgb mix(render::Rgb a, render::Rgb b, double t) {
  const auto channel = [t](std::uint8_t from, std::uint8_t to) { return static_cast<std::uint8_t>(std::lround(from + t * (to - from))); };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

void apply_colours(const Palette& p) {
  ImVec4* c = ImGui::GetStyle().Colors;
  const ImVec4 none{0, 0, 0, 0};
  const render::Rgb hover = mix(p.raised, p.text, 0.12), active = mix(p.raised, p.text, 0.22);
  c[ImGuiCol_Text] = colour_vector(p.text);
  c[ImGuiCol_TextDisabled] = colour_vector(mix(p.panel, p.dim, 0.72));
  c[ImGuiCol_WindowBg] = c[ImGuiCol_MenuBarBg] = colour_vector(p.panel);
  c[ImGuiCol_ChildBg] = none;
  c[ImGuiCol_PopupBg] = colour_vector(p.panel);
  c[ImGuiCol_Border] = c[ImGuiCol_Separator] = c[ImGuiCol_TableBorderLight] = c[ImGuiCol_TableBorderStrong] = colour_vector(p.line);
  c[ImGuiCol_BorderShadow] = none;
  c[ImGuiCol_FrameBg] = c[ImGuiCol_Button] = colour_vector(p.raised);
  c[ImGuiCol_FrameBgHovered] = c[ImGuiCol_ButtonHovered] = colour_vector(hover);
  c[ImGuiCol_FrameBgActive] = c[ImGuiCol_ButtonActive] = colour_vector(active);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = colour_vector(p.raised);
  c[ImGuiCol_ScrollbarBg] = none;
  c[ImGuiCol_ScrollbarGrab] = colour_vector(mix(p.panel, p.dim, 0.35));
  c[ImGuiCol_ScrollbarGrabHovered] = colour_vector(mix(p.panel, p.dim, 0.55));
  c[ImGuiCol_ScrollbarGrabActive] = colour_vector(p.dim);
  c[ImGuiCol_CheckMark] = c[ImGuiCol_NavHighlight] = colour_vector(p.accent);
  c[ImGuiCol_SliderGrab] = c[ImGuiCol_SliderGrabActive] = colour_vector(p.accent, 0.55F);  // it passes under the slider's number
  c[ImGuiCol_Header] = colour_vector(p.accent, 0.22F);
  c[ImGuiCol_HeaderHovered] = colour_vector(p.accent, 0.30F);
  c[ImGuiCol_HeaderActive] = colour_vector(p.accent, 0.40F);
  c[ImGuiCol_SeparatorHovered] = c[ImGuiCol_SeparatorActive] = colour_vector(p.accent);
  c[ImGuiCol_ResizeGrip] = none;
  c[ImGuiCol_Tab] = c[ImGuiCol_TabUnfocused] = none;
  c[ImGuiCol_TabHovered] = colour_vector(hover);
  c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = colour_vector(p.raised);
  c[ImGuiCol_PlotHistogram] = colour_vector(p.accent);
  c[ImGuiCol_TableHeaderBg] = none;
  c[ImGuiCol_TableRowBg] = none;
  c[ImGuiCol_TableRowBgAlt] = colour_vector(p.text, 0.025F);
  c[ImGuiCol_TextSelectedBg] = colour_vector(p.accent, 0.35F);
  c[ImGuiCol_ModalWindowDimBg] = c[ImGuiCol_NavWindowingDimBg] = {0, 0, 0, 0.45F};
  c[ImGuiCol_NavWindowingHighlight] = colour_vector(p.accent);
}

}  // namespace

const Palette& palette(Theme theme) { return theme == Theme::Light ? kLight : theme == Theme::Contrast ? kContrast : kDark; }

double contrast(render::Rgb a, render::Rgb b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

ImU32 colour(render::Rgb rgb, float alpha) {
  return IM_COL32(rgb.r, rgb.g, rgb.b, static_cast<unsigned>(std::lround(255.0F * std::clamp(alpha, 0.0F, 1.0F))));
}

ImVec4 colour_vector(render::Rgb rgb, float alpha) {
  return {static_cast<float>(rgb.r) / 255.0F, static_cast<float>(rgb.g) / 255.0F, static_cast<float>(rgb.b) / 255.0F, alpha};
}

void apply_style(Theme theme, double scale) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  const float s = static_cast<float>(scale);
  const auto px = [s](float value) { return std::round(value * s); };
  style.WindowPadding = {px(12), px(10)};
  style.FramePadding = {px(8), px(4)};
  style.CellPadding = {px(5), px(2)};
  style.ItemSpacing = {px(8), px(6)};
  style.ItemInnerSpacing = {px(6), px(4)};
  style.IndentSpacing = px(16);
  style.ScrollbarSize = px(11);
  style.GrabMinSize = px(10);
  style.WindowBorderSize = 0;
  style.ChildBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = theme == Theme::Contrast ? 1.0F : 0.0F;
  style.WindowRounding = 0;
  style.ChildRounding = style.FrameRounding = style.GrabRounding = style.TabRounding = px(4);
  style.PopupRounding = px(6);
  style.ScrollbarRounding = px(6);
  style.DisabledAlpha = 0.45F;
  style.CurveTessellationTol = 1.0F;
  apply_colours(palette(theme));
}

render::Style scene_style(const ViewState& state) {
  render::Style style = state.theme == Theme::Light ? render::Style::light() : render::Style::dark();
  style.background = palette(state.theme).background;
  style.wireframe = state.wireframe;
  style.vertices = state.vertices;
  style.shading = state.shading;
  style.occlusion = state.occlusion;
  style.scale = static_cast<float>(state.scale);
  style.colours.map = state.colour_map;
  // In space the lighting shows the form, and edges close to one another would hide it.
  if (state.in_space && state.shading && state.theme != Theme::Contrast) style.wire_colour.a /= 2;
  return style;
}

}  // namespace dmoscope::ui
