#include "formats/mitsuba/scene_texts.h"

namespace waylight {
namespace {

using mitsuba::Document;
using testing::error_of;
using testing::mentions;
using DocumentTest = testing::MitsubaScenes;

TEST_F(DocumentTest, OldSpellingsBecomeTheNewOnes) {
  const Document document = parse(R"(<shape type="obj"><transform name="toWorld">
    <lookAt origin="0,0,0" target="0,0,1"/></transform><float name="intIOR" value="1"/>
    <rgb name="sigmaS" value="1"/><float name="alphaU" value="1"/></shape>)",
                                  "0.6.0");
  EXPECT_TRUE(document.old_dialect);
  const std::vector<mitsuba::Element>& children = document.root.children[0].children;
  EXPECT_EQ(children[0].name, "to_world");
  EXPECT_EQ(children[0].children[0].tag, "lookat");
  EXPECT_EQ(children[1].name, "int_ior");
  EXPECT_EQ(children[2].name, "sigma_s");
  EXPECT_EQ(children[3].name, "alpha_u");
}

TEST_F(DocumentTest, NewSpellingsStay) {
  const Document document = parse(R"(<bsdf type="x"><float name="A" value="1"/></bsdf>)");
  EXPECT_FALSE(document.old_dialect);
  EXPECT_EQ(document.root.children[0].children[0].name, "A");
}

TEST_F(DocumentTest, DefineBeatsDefaultAndUnusedOnesAreListed) {
  options_.defines = {{"res", "7"}, {"nobody", "1"}};
  const Document document = parse(R"(<default name="res" value="3"/>
    <default name="folder" value="a"/><film type="$folder$res" id="-$res"/>)");
  EXPECT_EQ(document.root.children[0].type, "a7");
  EXPECT_EQ(document.root.children[0].id, "-7");
  EXPECT_EQ(document.unused_defines, std::vector<std::string>{"nobody"});
}

TEST_F(DocumentTest, TheLongestDefinedNameIsReplaced) {
  const Document document = parse(R"(<default name="s" value="1"/><default name="spp" value="2"/>
    <film type="$spp $s $sxy"/>)");
  EXPECT_EQ(document.root.children[0].type, "2 1 1xy");
}

TEST_F(DocumentTest, UndefinedNameIsAnErrorWithRemedy) {
  const std::string error =
      parse_error("<default name=\"width\" value=\"1\"/>\n<film type=\"$widht\"/>");
  EXPECT_TRUE(mentions(error, "scene.xml\":3")) << error;
  EXPECT_TRUE(mentions(error, "-D widht=VALUE")) << error;
  EXPECT_TRUE(mentions(error, "did you mean \"width\"")) << error;
}

TEST_F(DocumentTest, NamesThatMultiplyAreStopped) {
  std::string body = "<default name=\"a\" value=\"0123456789\"/>\n";
  for (char name = 'b'; name < 'i'; ++name) {  // 10^8 bytes in the last
    std::string ten;
    for (int i = 0; i < 10; ++i) ten += {'$', static_cast<char>(name - 1)};
    body += fmt::format("<default name=\"{}\" value=\"{}\"/>\n", name, ten);
  }
  const std::string error = parse_error(body);
  EXPECT_TRUE(mentions(error, "scene.xml\":9: <default")) << error;
  EXPECT_TRUE(mentions(error, "more than 32 MiB")) << error;
}

TEST_F(DocumentTest, IncludesAreSplicedInTheirOwnDialect) {
  std::filesystem::create_directory(path("parts"));
  put("parts/a.xml", wrap("<include filename=\"b.xml\"/>", "0.6.0"));
  put("parts/b.xml", "<shape type=\"obj\"><boolean name=\"faceNormals\" value=\"$flag\"/></shape>");
  const Document document = parse(R"(<default name="flag" value="true"/>
    <include filename="parts/a.xml"/><shape type="ply"/>)");
  ASSERT_EQ(document.root.children.size(), 2u);
  const mitsuba::Element& property = document.root.children[0].children[0];
  EXPECT_EQ(property.name, "face_normals");
  EXPECT_EQ(*property.attribute("value"), "true");
  EXPECT_TRUE(mentions(property.file, "b.xml"));
}

TEST_F(DocumentTest, IncludeCycleIsRefused) {
  put("a.xml", wrap("<include filename=\"b.xml\"/>"));
  put("b.xml", wrap("<include filename=\"./a.xml\"/>"));
  const std::string error = parse_error("<include filename=\"a.xml\"/>");
  EXPECT_TRUE(mentions(error, "includes itself")) << error;
}

TEST_F(DocumentTest, IncludesThatMultiplyAreStopped) {
  std::string twice;
  for (int i = 0; i < 32; ++i) twice += "<include filename=\"NEXT\"/>";
  for (int level = 0; level < 6; ++level) {
    std::string text = twice;
    for (size_t at; (at = text.find("NEXT")) != text.npos;)
      text.replace(at, 4, "level" + std::to_string(level + 1) + ".xml");
    put("level" + std::to_string(level) + ".xml", wrap(text));
  }
  put("level6.xml", wrap("<film type=\"x\"/>"));
  const std::string error = parse_error("<include filename=\"level0.xml\"/>");
  EXPECT_TRUE(mentions(error, "more than 4096 includes")) << error;
}

TEST_F(DocumentTest, MissingIncludeNamesWhoAskedForIt) {
  const std::string error = parse_error("\n<include filename=\"nowhere.xml\"/>");
  EXPECT_TRUE(mentions(error, "scene.xml\":3: <include>")) << error;
  EXPECT_TRUE(mentions(error, "nowhere.xml")) << error;
}

TEST_F(DocumentTest, FilesAreFoundInPathFolders) {
  std::filesystem::create_directory(path("meshes"));
  put("meshes/a.obj", "");
  const Document document = parse("<path value=\"meshes\"/><shape type=\"obj\"/>");
  EXPECT_EQ(std::filesystem::path(document.find_file(document.root, "a.obj")),
            std::filesystem::path(path("meshes")) / "a.obj");
}

TEST_F(DocumentTest, DuplicateIdNamesBothPlaces) {
  const std::string error = parse_error("<bsdf type=\"x\" id=\"a\"/>\n<bsdf type=\"y\" id=\"a\"/>");
  EXPECT_TRUE(mentions(error, ":2:") && mentions(error, ":3:")) << error;
}

TEST_F(DocumentTest, AliasIsASecondName) {
  const Document document = parse("<bsdf type=\"x\" id=\"a\"/><alias id=\"a\" as=\"b\"/>");
  EXPECT_EQ(document.ids.at("a"), document.ids.at("b"));
}

TEST_F(DocumentTest, DanglingReferenceSuggestsTheNearestId) {
  const std::string error =
      parse_error("<bsdf type=\"x\" id=\"glass\"/><shape type=\"obj\"><ref id=\"glas\"/></shape>");
  EXPECT_TRUE(mentions(error, "did you mean \"glass\"")) << error;
}

TEST_F(DocumentTest, ReferenceCycleIsRefused) {
  const std::string error = parse_error(R"(<bsdf type="twosided" id="a"><ref id="b"/></bsdf>
    <bsdf type="twosided" id="b"><bsdf type="mask"><ref id="a"/></bsdf></bsdf>)");
  EXPECT_TRUE(mentions(error, "contains itself")) << error;
}

TEST_F(DocumentTest, LongChainOfReferencesIsRefusedInEitherOrder) {
  std::string forwards, backwards;
  for (int i = 0; i < 2000; ++i) {
    const auto element = [](int id) {
      return fmt::format("<bsdf type=\"x\" id=\"{}\"><ref id=\"{}\"/></bsdf>", id, id + 1);
    };
    forwards += element(i);
    backwards += element(1999 - i);
  }
  const std::string last = "<bsdf type=\"x\" id=\"2000\"/>";
  EXPECT_TRUE(mentions(parse_error(forwards + last), "nested deeper"));
  EXPECT_TRUE(mentions(parse_error(last + backwards), "nested deeper"));
}

TEST_F(DocumentTest, DeepNestingIsRefused) {
  std::string open, close;
  for (int i = 0; i < 100000; ++i) open += "<bsdf type=\"x\">", close += "</bsdf>";
  EXPECT_TRUE(mentions(parse_error(open + close), "nested deeper"));
  EXPECT_TRUE(mentions(parse_error(open), "not well-formed"));
}

TEST_F(DocumentTest, BrokenXmlNamesFileAndLine) {
  const std::string error = parse_error("<film type=\"x\">\n\n</flim>");
  EXPECT_TRUE(mentions(error, "scene.xml\":4")) << error;
}

TEST_F(DocumentTest, SlipsAreErrorsThatNameTheLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"<shpae type=\"obj\"/>", "did you mean \"shape\""},
      {"<shape/>", "needs a type"},
      {"<shape type=\"obj\" ido=\"x\"/>", "unknown attribute \"ido\""},
      {"<shape type=\"obj\"><float value=\"1\"/></shape>", "needs a name"},
      {"<shape type=\"obj\"><ref/></shape>", "needs an id"},
      {"<shape type=\"obj\">text</shape>", "text between elements"},
      {"<rotate x=\"1\" angle=\"3\"/>", "cannot stand in"},
      {"<shape type=\"obj\"><float name=\"a\"><float name=\"b\"/></float></shape>",
       "cannot stand in"},
      {"<default value=\"3\"/>", "needs a name"},
      {"<path value=\"no-such-folder\"/>", "there is no folder"}};
  for (const auto& [body, message] : cases) {
    const std::string error = parse_error(body);
    EXPECT_TRUE(mentions(error, message)) << error;
    EXPECT_TRUE(mentions(error, "scene.xml\":2")) << error;
  }
}

TEST_F(DocumentTest, VersionIsNeededAndUnderstood) {
  EXPECT_TRUE(
      mentions(error_of([&] { mitsuba::parse_document(put("a.xml", "<scene/>"), options_); }),
               "needs a version"));
  EXPECT_TRUE(mentions(parse_error("", "new"), "is no version"));
  EXPECT_TRUE(mentions(parse_error("", "0.3.0"), "too old"));
  options_.on_warning = [this](const std::string& text) { warnings_.push_back(text); };
  parse("", "4.0.0");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_TRUE(mentions(warnings_[0], "newer"));
}

TEST_F(DocumentTest, WhatIsNoSceneIsRefused) {
  for (const char* text : {"", "   ", "<bsdf type=\"x\"/>", "\xff\xfe<", "PK\x03\x04", "<scene"}) {
    const std::string error =
        error_of([&] { mitsuba::parse_document(put("a.xml", text), options_); });
    EXPECT_TRUE(mentions(error, "a.xml")) << error;
  }
}

TEST(DidYouMean, FindsSlipsAndListsWhatIsKnownOtherwise) {
  const std::vector<std::string> known = {"diffuse", "dielectric", "to_world"};
  EXPECT_TRUE(mentions(mitsuba::did_you_mean("difuse", known), "\"diffuse\""));
  EXPECT_TRUE(mentions(mitsuba::did_you_mean("deilectric", known), "\"dielectric\""));
  EXPECT_TRUE(mentions(mitsuba::did_you_mean("toWorld", known), "\"to_world\""));
  EXPECT_EQ(mitsuba::did_you_mean("hair", known), "; known are diffuse, dielectric, to_world");
  EXPECT_EQ(mitsuba::did_you_mean("hair", {}), "");
}

TEST(DidYouMean, ListsNoThousandNames) {
  std::vector<std::string> known;
  for (int i = 0; i < 1000; ++i) known.push_back(fmt::format("material-{}", i));
  const std::string hint = mitsuba::did_you_mean("hair", known);
  EXPECT_TRUE(mentions(hint, "material-39, ...") && !mentions(hint, "material-40")) << hint;
}

}  // namespace
}  // namespace waylight
