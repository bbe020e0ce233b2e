#pragma once
// Scene files of tests, written to a folder of their own.

#include "formats/mitsuba.h"
#include "formats/mitsuba/properties.h"
#include "formats/temporary_files.h"

namespace waylight::testing {

class MitsubaScenes : public TemporaryFiles {
 protected:
  static std::string wrap(const std::string& body, const std::string& version = "3.0.0") {
    return "<scene version=\"" + version + "\">\n" + body + "\n</scene>\n";
  }

  mitsuba::Document parse(const std::string& body, const std::string& version = "3.0.0") {
    return mitsuba::parse_document(put("scene.xml", wrap(body, version)), options_);
  }
  std::string parse_error(const std::string& body, const std::string& version = "3.0.0") {
    return error_of([&] { parse(body, version); });
  }

  SceneDescription import(const std::string& body, const std::string& version = "3.0.0") {
    options_.on_warning = [this](const std::string& text) { warnings_.push_back(text); };
    return import_mitsuba(put("scene.xml", wrap(body, version)), options_);
  }
  std::string import_error(const std::string& body, const std::string& version = "3.0.0") {
    return error_of([&] { import(body, version); });
  }

  ImportOptions options_;
  std::vector<std::string> warnings_;
};

}  // namespace waylight::testing
