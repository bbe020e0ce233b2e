#pragma once
// What the tool image-compare does, apart from its command line.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "tools/common/cli.h"

namespace waylight {

struct ImageCompareOptions {
  std::string image, reference;
  std::vector<std::string> repeats;           // renders of the image with other seeds
  std::string csv, error_image;               // files to write, empty: none
  std::vector<std::string> variances;         // pictures, or "self"
  double variance_samples = 1;                // pictures of variances are divided by this
  int tile_size = 8;                          // pixels, 1..4096
  double z_floor = 0;                         // deviation, as a share of the reference's mean
  std::vector<std::string> labels;            // name=value
  std::string stats;                          // JSON of `render --stats`
  std::vector<std::string> preprocess_stats;  // JSON of other stages
  std::vector<int> crop;                      // x, y, width, height, or empty
  bool resize_reference = false;
  bool subtract_reference_noise = false;  // by its channels of variance
  bool json = false;

  void validate() const;
};

// Columns of the table that describe the image; values come from statistics, then from labels.
inline constexpr std::array kImageLabels{
    "scene", "method",    "seed",        "seconds",     "cpu_seconds", "preprocess_seconds",
    "spp",   "sample_ms", "path_length", "memory_bytes"};
using ImageLabels = std::map<std::string, std::string>;
ImageLabels collect_labels(const ImageCompareOptions& options);

void declare(CLI::App& app, ImageCompareOptions& options);  // the command line

// Prints the figures on stdout, and writes the files asked for.
void image_compare(const ToolRun& run, const ImageCompareOptions& options);

}  // namespace waylight
