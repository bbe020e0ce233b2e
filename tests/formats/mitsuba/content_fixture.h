#pragma once
// A scene file of a few lines, and what the importers of materials, emitters and media make of it.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "formats/mitsuba/import_context.h"

namespace waylight::mitsuba {

enum class Dialect { old, current };
inline constexpr Dialect kBoth[] = {Dialect::old, Dialect::current};

// A folder that is gone with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static int count = 0;
    path_ = std::filesystem::path(::testing::TempDir()) /
            fmt::format("waylight-content-{}-{}", getpid(), ++count);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

class Content {
 public:
  explicit Content(Dialect dialect, bool lenient = false) : dialect_(dialect) {
    options_.lenient = lenient;
    options_.on_warning = [this](const std::string& warning) { warnings.push_back(warning); };
  }

  // Imports the children of <scene> one after another.
  void import(const std::string& body) {
    const char* version = dialect_ == Dialect::old ? "0.6.0" : "3.0.0";
    std::ofstream(file("scene.xml"))
        << fmt::format("<scene version=\"{}\">\n{}\n</scene>", version, body);
    document_ = parse_document(file("scene.xml"), options_);
    forget_elements();
    for (const Element& element : document_.root.children) import(element);
  }
  std::string error_of(const std::string& body) {
    try {
      import(body);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  template <typename Model>
  Model material(const std::string& body) {
    import(body);
    return std::get<Model>(scene.materials.back().model);
  }
  template <typename Light>
  Light emitter(const std::string& body) {
    import(body);
    return std::get<Light>(scene.emitters.back());
  }
  template <typename Coefficients>
  Coefficients medium(const std::string& body) {
    import(body);
    return std::get<Coefficients>(scene.media.back().coefficients);
  }
  // As reflectance of a diffuse material.
  Texture texture(const std::string& body) {
    return material<DiffuseMaterial>("<bsdf type=\"diffuse\">" + body + "</bsdf>").reflectance;
  }

  std::string file(const std::string& name) const { return folder_.file(name); }

  SceneDescription scene;
  std::vector<std::string> warnings;
  std::vector<Color> radiances;  // of area lights, at uv (0, 0)

 private:
  // Those of the document before are gone, and others may stand in their places.
  void forget_elements() {
    context_.materials.clear();
    context_.media.clear();
    context_.textures.clear();
    context_.volumes.clear();
  }
  void import(const Element& element) {
    if (element.tag == "bsdf") import_material(context_, element);
    if (element.tag == "medium") import_medium(context_, element);
    if (element.tag != "emitter") return;
    if (element.type == "area")
      radiances.push_back(import_area_radiance(context_, element).eval(Vec2::Zero()));
    else
      import_emitter(context_, element);
  }

  Dialect dialect_;
  TemporaryFolder folder_;
  ImportOptions options_;
  Document document_;
  ImportContext context_{document_, options_, scene, {}, {}, {}, {}};
};

inline std::string with_type(const std::string& type, const std::string& body = "") {
  return fmt::format("<bsdf type=\"{}\">{}</bsdf>", type, body);
}

inline void expect_color(const Color& actual, const Color& expected, float tolerance = 1e-5f) {
  EXPECT_TRUE(((actual - expected).abs() <= tolerance).all())
      << actual.transpose() << " instead of " << expected.transpose();
}

}  // namespace waylight::mitsuba
