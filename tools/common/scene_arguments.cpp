#include "tools/common/scene_arguments.h"

#include <CLI/CLI.hpp>

#include "formats/mitsuba.h"
#include "libguide/base/error.h"

namespace waylight {
namespace {

void add_import_options(CLI::App& app, SceneArguments& arguments) {
  app.add_option("-D", arguments.defines, "Value for a $name of the scene; repeatable")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->group("Scene");
  app.add_flag("--lenient", arguments.lenient,
               "Replace unknown materials by grey and leave unknown shapes out, with a warning")
      ->group("Scene");
  app.add_flag("--two-sided", arguments.two_sided,
               "Let opaque materials reflect on both sides, as if each were in \"twosided\"")
      ->group("Scene");
}

std::map<std::string, std::string> parse_defines(const std::vector<std::string>& defines) {
  std::map<std::string, std::string> values;
  for (const std::string& define : defines) {
    const size_t equals = define.find('=');
    require(equals != define.npos && equals > 0, "-D {}: write it as -D name=value", define);
    values[define.substr(0, equals)] = define.substr(equals + 1);
  }
  return values;
}

}  // namespace

void add_scene(CLI::App& app, SceneArguments& arguments) {
  as_input(app.add_option("SCENE", arguments.path, "Mitsuba scene file (XML)"))->required();
  add_import_options(app, arguments);
}

void add_ignore_media(CLI::App& app, SceneArguments& arguments) {
  app.add_flag("--ignore-media", arguments.ignore_media, "Trace as if media were vacuum")
      ->group("Scene");
}

void add_scene_option(CLI::App& app, SceneArguments& arguments, const char* name,
                      const char* description) {
  as_input(app.add_option(name, arguments.path, description))->group("Scene");
  add_import_options(app, arguments);
}

SceneDescription load_scene(const SceneArguments& arguments, const ToolRun& run) {
  ImportOptions options;
  options.defines = parse_defines(arguments.defines);
  options.lenient = arguments.lenient;
  options.two_sided = arguments.two_sided;
  options.on_warning = run.control.on_warning;
  options.on_file = [&](const std::string& file) { run.check_referred(file, arguments.written); };
  return import_mitsuba(arguments.path, options);
}

namespace {

void leave_out_media(SceneDescription& scene) {
  scene.media.clear();
  scene.sensor.medium = kNone;
  for (std::vector<Shape>* shapes : {&scene.shapes, &scene.group_shapes})
    for (Shape& shape : *shapes) shape.interior_medium = shape.exterior_medium = kNone;
}

}  // namespace

std::unique_ptr<Scene> build_scene(SceneDescription description, const SceneArguments& arguments,
                                   const ToolRun& run) {
  if (arguments.ignore_media && !description.media.empty()) {
    run.control.warn(fmt::format("{} media are ignored", description.media.size()));
    leave_out_media(description);
  }
  auto scene = std::make_unique<Scene>(std::move(description));
  for (const std::string& warning : scene->build_warnings()) run.control.warn(warning);
  return scene;
}

}  // namespace waylight
