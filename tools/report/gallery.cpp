#include "tools/report/gallery.h"

#include <fmt/format.h>

#include <cmath>

#include "formats/image_io.h"
#include "libguide/image/compare.h"
#include "tools/report/figures.h"
#include "tools/report/html.h"

namespace waylight {
namespace {

constexpr int kQuality = 88;  // of JPEG

Bitmap reduced(const Bitmap& picture, int width) {
  if (picture.width <= width) return picture;
  const double height = static_cast<double>(picture.height) * width / picture.width;
  return downsample(picture, width, std::max(1, static_cast<int>(std::lround(height))));
}

std::string img(const std::string& uri, const std::string& alt) {
  return fmt::format("<img src=\"{}\" alt=\"{}\">", uri, escaped(alt));
}

std::string frame(const char* view, const std::string& content) {
  return fmt::format("<div class=\"frame {0}\" data-flip={0}>{1}<b></b></div>\n", view, content);
}

// Where the crop is, in percent of the picture.
std::string crop_mark(const PixelWindow& crop, const Bitmap& picture) {
  const double x = 100.0 / picture.width, y = 100.0 / picture.height;
  return fmt::format("<i style=\"left:{:.2f}%;top:{:.2f}%;width:{:.2f}%;height:{:.2f}%\"></i>",
                     crop.x * x, crop.y * y, crop.width * x, crop.height * y);
}

std::string views(const Shot& shot, const std::string& name, const PixelWindow& window,
                  const ReportOptions& options) {
  const auto jpeg = [&](const Bitmap& picture, float exposure) {
    return data_uri("jpeg", jpeg_bytes(reduced(picture, options.width), exposure, kQuality));
  };
  std::string html =
      frame("full",
            img(jpeg(shot.picture, options.exposure), name) + crop_mark(window, shot.picture)) +
      frame("crop", img(data_uri("png", png_bytes(crop(shot.picture, window), options.exposure)),
                        name + ", enlarged"));
  if (!shot.errors.empty())
    html += frame("error",
                  img(jpeg(false_color(shot.errors, shot.picture.width, shot.picture.height), 0),
                      name + ", error"));
  return html;
}

std::string figure(const std::string& name, const std::string& facts, const std::string& views) {
  return fmt::format(
      "<figure data-name=\"{0}\"><figcaption>{0}<small>{1}</small></figcaption>\n{2}"
      "</figure>\n",
      escaped(name), facts, views);
}

// The colours of errors from 1e-4 to 1.
std::string legend() {
  constexpr int kSteps = 128;
  std::vector<float> ramp(kSteps);
  for (int i = 0; i < kSteps; ++i) ramp[i] = std::pow(10.0f, -4 + 4 * (i + 0.5f) / kSteps);
  return "<div class=legend>relative squared error" +
         img(data_uri("png", png_bytes(false_color(ramp, kSteps, 1))), "colours of errors") +
         "<span><i>0.0001</i><i>0.01</i><i>1</i></span></div>\n";
}

std::string flip_choice(const SceneRuns& scene, const std::string& id) {
  std::string html = fmt::format(
      "<p class=facts>With the pointer on a picture, show <select data-gallery={}>"
      "<option>reference</option>",
      id);
  for (const Method& method : scene.methods)
    html += "<option>" + escaped(method.name) + "</option>";
  return html + "</select> in its place.</p>\n";
}

}  // namespace

std::string gallery(const SceneRuns& scene, const Pictures& pictures, const std::string& id,
                    const ReportOptions& options) {
  std::string html = flip_choice(scene, id) + "<div class=gallery id=" + id + ">\n";
  const std::string own_error =
      pictures.reference_error ? "own relMSE " + text_of(*pictures.reference_error) : "";
  html += figure("reference", own_error,
                 views(pictures.reference, "reference", pictures.crop, options) + legend());
  for (size_t i = 0; i < scene.methods.size(); ++i) {
    const Checkpoint& last = scene.methods[i].last();
    const std::string facts =
        fmt::format("relMSE {} &middot; {} s &middot; {} spp", text_of(last.relmse),
                    text_of(last.seconds), text_of(last.spp));
    html += figure(scene.methods[i].name, facts,
                   views(pictures.methods[i], scene.methods[i].name, pictures.crop, options));
  }
  return html + "</div>\n";
}

}  // namespace waylight
