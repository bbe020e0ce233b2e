// image-compare: how far an image is from its reference.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "libguide/base/error.h"
#include "tools/image-compare/compare_tool.h"

namespace {

void add_options(CLI::App& app, waylight::ImageCompareOptions& options) {
  app.add_option("image", options.image, "Image to judge")->required();
  app.add_option("reference", options.reference, "What it should be")->required();
  app.add_option("--csv", options.csv, "Append the figures as a row of this table");
  app.add_option("--error-image", options.error_image,
                 "Relative error in false colours (.png), with the difference's channels (.exr)");
  app.add_option("--z", options.variances,
                 "z-scores against this variance of the mean: a picture, or `self` for the "
                 "channels variance.R, G, B of image and reference; several are added")
      ->allow_extra_args(false);
  app.add_option("--z-samples", options.variance_samples,
                 "Variance pictures are of one sample; divide them by this number of samples");
  app.add_option("--tile", options.tile_size, "Side of the tiles that have z-scores, in pixels");
  app.add_option("--label", options.labels,
                 "scene=, method=, seconds=, preprocess_seconds= or spp= for the table")
      ->allow_extra_args(false);
  app.add_option("--stats", options.stats, "Take labels from what `render --stats` wrote");
  app.add_option("--preprocess-stats", options.preprocess_stats,
                 "Add the seconds of this stage's --stats to preprocess_seconds")
      ->allow_extra_args(false);
  app.add_option("--crop", options.crop, "Compare only x,y,width,height")
      ->delimiter(',')
      ->expected(4);
  app.add_flag("--resize-reference", options.resize_reference,
               "Reduce a larger reference to the size of the image");
  app.add_flag("--json", options.json, "Print JSON");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How far an image is from its reference");
  waylight::ImageCompareOptions options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
    waylight::image_compare(options, [](const std::string& message) {
      fmt::print(stderr, "image-compare: warning: {}\n", message);
    });
    return 0;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const std::exception& e) {
    fmt::print(stderr, "image-compare: {}\n", e.what());
    return dynamic_cast<const waylight::Misuse*>(&e) ? 2 : 1;
  }
}
