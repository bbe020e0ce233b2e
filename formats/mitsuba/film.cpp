#include "formats/mitsuba/film.h"

#include "formats/mitsuba/types.h"
#include "libguide/scene/camera.h"

namespace waylight::mitsuba {
namespace {

constexpr int kMaxFilmSize = 1 << 16;

// What a film does with the finished picture; here that is for who writes the image.
const std::vector<std::string> kOutputOptions = {
    "attach_log",   "banner",       "burn",  "component_format", "compensate",
    "exposure",     "file_format",  "gamma", "filename",         "high_quality_edges",
    "key",          "pixel_format", "label", "sample_border",    "tonemap_method",
    "channel_names"};

void import_box(ImportContext& /*context*/, Properties& /*properties*/, FilmDescription& film) {
  film.filter = FilterType::box;
}

void import_tent(ImportContext& /*context*/, Properties& /*properties*/, FilmDescription& film) {
  film.filter = FilterType::tent;
}

void import_gaussian(ImportContext& /*context*/, Properties& properties, FilmDescription& film) {
  film.filter = FilterType::gaussian;
  film.filter_stddev = properties.number("stddev", 0.5f);
  if (!(film.filter_stddev > 0)) fail_at(properties.element(), "its stddev must be above 0");
  // Both dialects cut after four deviations.
  if (!properties.has("radius")) film.filter_radius = 4 * film.filter_stddev;
}

// B and C of [Mitchell, Netravali 1988]. Mitsuba 3 reads them by these names, but its manual calls
// them A and B: so they are taken where there is an A and no C.
void import_mitchell(ImportContext& context, Properties& properties, FilmDescription& film) {
  film.filter = FilterType::mitchell;
  const bool old = context.document.old_dialect;
  const bool as_documented = !old && !properties.has("C") && properties.has("A");
  const char* b = old ? "b" : as_documented ? "A" : "B";
  const char* c = old ? "c" : as_documented ? "B" : "C";
  film.filter_b = properties.number(b, 1.0f / 3);
  film.filter_c = properties.number(c, 1.0f / 3);
}

// Catmull-Rom is the member B = 0, C = 1/2 of the Mitchell family; Lanczos is near to it.
void replace(ImportContext& context, Properties& properties, FilmDescription& film) {
  const Element& element = properties.element();
  if (!context.options.lenient)
    fail_at(element, "is not supported; use mitchell, or --lenient to have it replaced");
  context.warn(fmt::format("{}: replaced by mitchell with B = 0, C = 1/2", element.where()));
  properties.ignore({"lobes"});
  film.filter_radius = 0;
  film.filter = FilterType::mitchell;
  film.filter_b = 0;
  film.filter_c = 0.5f;
}

using FilterImporter = void (*)(ImportContext&, Properties&, FilmDescription&);
const std::map<std::string, FilterImporter> kFilters = {
    {"box", import_box},           {"tent", import_tent},   {"gaussian", import_gaussian},
    {"mitchell", import_mitchell}, {"catmullrom", replace}, {"lanczos", replace}};

void import_filter(ImportContext& context, const Element& element, FilmDescription& film) {
  Properties properties(context.document, element);
  const FilterImporter importer = importer_of(element, kFilters, "filter");
  film.filter_radius = properties.number("radius", 0);
  if (film.filter_radius < 0) fail_at(element, "its radius must not be negative");
  importer(context, properties, film);
  if (film.filter_radius > FilterSampler::kMaxRadius)
    fail_at(element, "reaches {} pixels far, at most {} are possible; make it narrower",
            film.filter_radius, FilterSampler::kMaxRadius);
  properties.finish();
}

int pixels(const Element& film, Properties& properties, const std::string& name, int otherwise,
           int least) {
  const int value = properties.integer(name, otherwise);
  if (value < least || value > kMaxFilmSize)
    fail_at(film, "its {} is {}, from {} to {} is possible", name, value, least, kMaxFilmSize);
  return value;
}

void import_crop(const Element& element, Properties& properties, FilmDescription& film) {
  film.crop_x = pixels(element, properties, "crop_offset_x", 0, 0);
  film.crop_y = pixels(element, properties, "crop_offset_y", 0, 0);
  const int width = film.width - film.crop_x, height = film.height - film.crop_y;
  film.crop_width = pixels(element, properties, "crop_width", std::max(width, 1), 1);
  film.crop_height = pixels(element, properties, "crop_height", std::max(height, 1), 1);
  if (film.crop_width > width || film.crop_height > height)
    fail_at(element, "its crop window reaches beyond its {} x {} pixels", film.width, film.height);
  if (film.crop_width == film.width && film.crop_height == film.height)
    film.crop_width = film.crop_height = 0;
}

}  // namespace

FilmDescription import_film(ImportContext& context, const Element& element) {
  Properties properties(context.document, element);
  if (element.type != "hdrfilm" && element.type != "ldrfilm")
    fail_at(element, "unknown film{}", did_you_mean(element.type, {"hdrfilm", "ldrfilm"}));
  FilmDescription film;
  film.width = pixels(element, properties, "width", film.width, 1);
  film.height = pixels(element, properties, "height", film.height, 1);
  import_crop(element, properties, film);
  if (const Element* filter = single(properties, "rfilter")) import_filter(context, *filter, film);
  properties.ignore(kOutputOptions);
  properties.finish();
  return film;
}

}  // namespace waylight::mitsuba
