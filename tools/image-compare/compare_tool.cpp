#include "tools/image-compare/compare_tool.h"

#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "formats/image_io.h"
#include "libguide/base/error.h"
#include "libguide/image/mean_picture.h"
#include "libguide/image/picture.h"
#include "tools/common/csv.h"
#include "tools/image-compare/report.h"

namespace waylight {
namespace {

constexpr const char* kVariance = "variance.";  // channels of `render --aov variance`

// Brings pictures that belong to the reference, or to the image, to the window that is compared.
class Framing {
 public:
  Framing(const ImageCompareOptions& options, int width, int height)
      : options_(options), width_(width), height_(height) {}

  Bitmap operator()(const Bitmap& picture, const std::string& path, PixelQuantity quantity) const {
    const bool fits = picture.width == width_ && picture.height == height_;
    if (!fits && !options_.resize_reference)
      fail(
          "\"{}\": has {} x {} pixels, \"{}\" has {} x {}; --resize-reference reduces a larger one",
          path, picture.width, picture.height, options_.image, width_, height_);
    return window(fits ? picture : downsample(picture, width_, height_, quantity));
  }

 private:
  Bitmap window(const Bitmap& picture) const {
    const std::vector<int>& w = options_.crop;
    return w.empty() ? picture : crop(picture, {w[0], w[1], w[2], w[3]});
  }

  const ImageCompareOptions& options_;
  int width_, height_;
};

Bitmap colors_in(const Image& image, const std::string& path, const std::string& prefix) {
  if (!has_color(image, prefix))
    fail("\"{0}\": has no channels {1}R, {1}G, {1}B{2}", path, prefix,
         prefix == kVariance ? "; render it with --aov variance" : "");
  return color_of(image, prefix);
}

// Colours of the image and its repeats, in the window.
std::vector<Bitmap> read_renders(const ImageCompareOptions& options, const Image& image,
                                 const Framing& frame, const std::string& prefix,
                                 PixelQuantity quantity) {
  std::vector<Bitmap> renders = {
      frame(colors_in(image, options.image, prefix), options.image, quantity)};
  for (const std::string& path : options.repeats)
    renders.push_back(frame(colors_in(read_image(path), path, prefix), path, quantity));
  return renders;
}

std::vector<double> relmse_of_each(const std::vector<Bitmap>& renders, const Bitmap& reference,
                                   const Bitmap* noise) {
  std::vector<double> result;
  for (const Bitmap& render : renders)
    result.push_back(waylight::compare(render, reference, noise).relmse);
  return result;
}

void add(Bitmap& sum, const Bitmap& term, double divisor) {
  for (size_t i = 0; i < sum.pixels.size(); ++i)
    sum.pixels[i] += term.pixels[i] / static_cast<float>(divisor);
}

// Of the difference: the sum of all variances named, each already in the window.
Bitmap total_variance(const ImageCompareOptions& options, const Image& image,
                      const Image& reference, const Framing& frame) {
  std::optional<Bitmap> sum;
  const auto add_term = [&](const Bitmap& term, double divisor) {
    if (!sum) {
      sum = term;
      for (Color& color : sum->pixels) color.setZero();
    }
    add(*sum, term, divisor);
  };
  const auto of_file = [&](const Image& source, const std::string& path,
                           const std::string& prefix) {
    return frame(colors_in(source, path, prefix), path, PixelQuantity::variance);
  };
  for (const std::string& variance : options.variances) {
    if (variance == "self") {
      const std::vector<Bitmap> own =
          read_renders(options, image, frame, kVariance, PixelQuantity::variance);
      add_term(mean_picture(own), static_cast<double>(own.size()));
      if (has_color(reference, kVariance))
        add_term(of_file(reference, options.reference, kVariance), 1);
    } else {
      const Image file = read_image(variance);
      add_term(of_file(file, variance, has_color(file, kVariance) ? kVariance : ""),
               options.variance_samples);
    }
  }
  return *sum;
}

std::optional<Bitmap> noise_to_subtract(const ImageCompareOptions& options, const Image& reference,
                                        const Framing& frame) {
  if (!options.subtract_reference_noise) return std::nullopt;
  return frame(colors_in(reference, options.reference, kVariance), options.reference,
               PixelQuantity::variance);
}

void write_error_image(const std::string& path, const Bitmap& image, const Bitmap& reference) {
  const std::vector<float> errors = relative_errors(image, reference);
  const Bitmap colors = false_color(errors, image.width, image.height);
  Image picture(image.width, image.height,
                {"R", "G", "B", "relative_error", "difference.R", "difference.G", "difference.B"});
  for (size_t i = 0; i < errors.size(); ++i) {
    float* pixel = picture.pixels.data() + i * picture.channels.size();
    for (int c = 0; c < 3; ++c) {
      pixel[c] = colors.pixels[i][c];
      pixel[4 + c] = image.pixels[i][c] - reference.pixels[i][c];
    }
    pixel[3] = errors[i];
  }
  path.ends_with(".exr") ? write_exr(path, picture) : write_png(path, picture);
}

CsvRow csv_row(const ImageLabels& labels, const CompareFigures& figures,
               const ImageCompareOptions& options) {
  CsvRow row;
  for (const char* name : kImageLabels) row.emplace_back(name, labels.at(name));
  const auto number = [&](const char* name, double value) {
    row.emplace_back(name, fmt::format("{:.8g}", value));
  };
  number("mse", figures.mse);
  number("relmse", figures.relmse);
  number("relmse_trimmed", figures.relmse_trimmed);
  number("mape", figures.mape);
  number("mean", figures.mean);
  number("ref_mean", figures.ref_mean);
  row.emplace_back("image", options.image);
  row.emplace_back("reference", options.reference);
  row.emplace_back("preprocess_stats", fmt::format("{}", fmt::join(options.preprocess_stats, ";")));
  return row;
}

}  // namespace

void ImageCompareOptions::validate() const {
  require(crop.empty() || crop.size() == 4, "--crop wants x,y,width,height");
  require(tile_size >= 1 && tile_size <= 4096, "--tile {} is not in 1..4096", tile_size);
  require(z_floor >= 0, "--z-floor {} is negative", z_floor);
  require(variance_samples >= 1, "--z-samples {} is less than 1", variance_samples);
}

void image_compare(const ToolRun& run, const ImageCompareOptions& options) {
  options.validate();
  const ImageLabels labels = collect_labels(options);
  const Image image = read_image(options.image), reference = read_image(options.reference);
  const Framing frame(options, image.width, image.height);
  for (const std::string& variance : options.variances)
    if (variance != "self") run.check_referred(variance);
  const std::vector<Bitmap> renders = read_renders(options, image, frame, "", PixelQuantity::mean);
  const Bitmap x = mean_picture(renders);
  const Bitmap ref =
      frame(colors_in(reference, options.reference, ""), options.reference, PixelQuantity::mean);
  const std::optional<Bitmap> noise = noise_to_subtract(options, reference, frame);
  const Bitmap* const noise_of_reference = noise ? &*noise : nullptr;
  ComparisonReport report{waylight::compare(x, ref, noise_of_reference),
                          relmse_of_each(renders, ref, noise_of_reference),
                          {}};
  if (!options.variances.empty())
    report.z = z_scores(x, ref, total_variance(options, image, reference, frame), options.tile_size,
                        options.z_floor * report.figures.ref_mean);
  if (options.variances == std::vector<std::string>{"self"} && !has_color(reference, kVariance))
    run.control.warn(fmt::format("\"{}\" has no channels of variance: its own noise counts as bias",
                                 options.reference));
  if (report.figures.non_finite > 0)
    run.control.warn(
        fmt::format("{} pixels are not finite and left out", report.figures.non_finite));
  if (!options.error_image.empty()) write_error_image(options.error_image, x, ref);
  if (!options.csv.empty()) append_csv(options.csv, csv_row(labels, report.figures, options));
  const nlohmann::ordered_json json = to_json(labels, report);
  options.json ? run.print(json_text(json)) : print_table(run, report);
  run.write_stats(json);
}

}  // namespace waylight
