#include "tools/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "formats/file_bytes.h"
#include "tools/report/figures.h"
#include "tools/report/gallery.h"
#include "tools/report/html.h"

namespace waylight {
namespace {

constexpr double kNoticeable = 0.1;  // share that a reference's own error has of a method's

std::string section_id(size_t index) { return fmt::format("scene-{}", index + 1); }

// What the reference cannot tell: where its own error is a good part of a method's.
std::string reference_warning(const SceneRuns& scene, const Pictures& pictures) {
  if (!pictures.reference_error)
    return "<p class=warning>The error of the reference is not known.</p>\n";
  double least = INFINITY;
  for (const Method& method : scene.methods) least = std::min(least, method.last().relmse);
  const double share = *pictures.reference_error / least;
  if (share < kNoticeable) return {};
  return fmt::format(
      "<p class=warning>The reference's own relMSE is {:.0f} % of the least in this table: the "
      "smallest errors are overestimated, unless its noise was taken out of them.</p>\n",
      100 * share);
}

std::string facts(const Pictures& pictures) {
  const Bitmap& picture = pictures.reference.picture;
  const std::string own = pictures.reference_error
                              ? ", relMSE about " + text_of(*pictures.reference_error) +
                                    " as estimated from its own variance"
                              : " of unknown error";
  return fmt::format("<p class=facts>{} &times; {} pixels; reference{}.</p>\n", picture.width,
                     picture.height, own);
}

std::string scene_section(const SceneRuns& scene, size_t index, const ReportOptions& options) {
  std::optional<PixelWindow> crop;
  if (const std::vector<int>& c = options.crop; !c.empty()) crop = {c[0], c[1], c[2], c[3]};
  const Pictures pictures = read_pictures(scene, crop);
  return fmt::format("<section id={}>\n<h2>{}</h2>\n", section_id(index), escaped(scene.name)) +
         facts(pictures) + gallery(scene, pictures, section_id(index) + "-pictures", options) +
         "<h3>Figures at the end of the longest render</h3>\n" + final_table(scene) +
         reference_warning(scene, pictures) + "<h3>Time to reach the error of " +
         escaped(scene.methods[0].name) + "</h3>\n" + reach_table_html(scene) +
         "<h3>Charts</h3>\n" + scene_charts(scene, options.output) + provenance(scene, pictures) +
         "</section>\n";
}

std::string links(const std::vector<SceneRuns>& scenes) {
  std::string html;
  for (size_t i = 0; i < scenes.size(); ++i)
    html += fmt::format("<a href=\"#{}\">{}</a>", section_id(i), escaped(scenes[i].name));
  return html;
}

std::string subtitle(const std::vector<SceneRuns>& scenes) {
  std::set<std::string> methods, seeds;
  double seconds = 0;
  for (const SceneRuns& scene : scenes)
    for (const Method& method : scene.methods) {
      methods.insert(method.name);
      for (const auto& run : method.seeds) {
        seeds.insert(run[0].seed);
        seconds = std::max(seconds, run.back().seconds);
      }
    }
  const auto count = [](size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
  };
  return fmt::format("{}, {}, {}, up to {} s of rendering each", count(scenes.size(), "scene"),
                     count(methods.size(), "method"), count(seeds.size(), "seed"),
                     text_of(seconds));
}

std::string more_charts(const std::vector<std::string>& files) {
  if (files.empty()) return {};
  std::string html;
  for (const std::string& file : files) {
    const std::string svg = inline_svg(read_whole_file(file));
    if (svg.empty()) fail("\"{}\": is not an SVG picture", file);
    html += svg;
  }
  return "<section><h2>Studies</h2>\n<div class=charts>\n" + html + "</div></section>\n";
}

// One method where all scenes begin with it, else what it is to each scene.
std::string base_name(const std::vector<SceneRuns>& scenes) {
  for (const SceneRuns& scene : scenes)
    if (scene.methods[0].name != scenes[0].methods[0].name) return "the first method";
  return escaped(scenes[0].methods[0].name);
}

}  // namespace

std::string report_page(const std::vector<SceneRuns>& scenes, const ReportOptions& options,
                        const ToolRun& run) {
  std::string sections;
  for (size_t i = 0; i < scenes.size(); ++i) {
    run.stop_if_interrupted();
    run.control.progress(static_cast<double>(i), static_cast<double>(scenes.size()), "scenes");
    sections += scene_section(scenes[i], i, options);
  }
  return filled(kPageHtml, {{"version", version()},
                            {"title", escaped(options.title)},
                            {"css", kPageCss},
                            {"subtitle", subtitle(scenes)},
                            {"links", links(scenes)},
                            {"base", base_name(scenes)},
                            {"summary", summary_tables(scenes)},
                            {"scenes", sections},
                            {"charts", more_charts(options.charts)},
                            {"stability", stability_section(options.stability)},
                            {"command", escaped(run.command_line())},
                            {"js", kPageJs}});
}

}  // namespace waylight
