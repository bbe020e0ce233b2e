#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "tools/image-compare/compare_tool.h"

namespace waylight {
namespace {

void declare_labels(CLI::App& app, ImageCompareOptions& options) {
  app.add_option("--label", options.labels,
                 fmt::format("{}= for the table", fmt::join(kImageLabels, "=, ")))
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  as_input(app.add_option("--render-stats", options.stats, "Labels from `render --stats`"));
  as_input(app.add_option("--preprocess-stats", options.preprocess_stats,
                          "Add the seconds of this stage's --stats to preprocess_seconds"))
      ->allow_extra_args(false);
}

}  // namespace

void declare(CLI::App& app, ImageCompareOptions& options) {
  as_input(app.add_option("IMAGE", options.image, "Image to judge"))->required();
  as_input(app.add_option("REFERENCE", options.reference, "What it should be"))->required();
  as_input(app.add_option("--repeat", options.repeats,
                          "Render of IMAGE with another seed: the mean of all is judged"))
      ->allow_extra_args(false);
  as_output(app.add_option("--csv", options.csv, "Append the figures as a row of this table"));
  as_output(
      app.add_option("--error-image", options.error_image,
                     "Relative error in false colours (.png), or with the differences (.exr)"),
      {".png", ".exr"});
  app.add_option("--z", options.variances, "Variance of the mean: a picture, or `self`; repeatable")
      ->type_name("self|FILE")
      ->allow_extra_args(false);
  app.add_option("--z-samples", options.variance_samples,
                 "Variance pictures are of one sample; divide them by this number of samples");
  app.add_option("--z-floor", options.z_floor,
                 "Deviation that differences may have beside it, as a share of the mean");
  app.add_option("--tile", options.tile_size, "Side of the tiles that have z-scores, in pixels");
  declare_labels(app, options);
  app.add_option("--crop", options.crop, "Compare this window only, in pixels")
      ->type_name("X,Y,W,H")
      ->delimiter(',')
      ->expected(4);
  app.add_flag("--resize-reference", options.resize_reference,
               "Reduce a larger reference to the size of the image");
  app.add_flag("--subtract-reference-noise", options.subtract_reference_noise,
               "Take the reference's own variance, which it has as channels, from squared errors");
  app.add_flag("--json", options.json, "Print JSON");
}

}  // namespace waylight
