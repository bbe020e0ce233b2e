#include "formats/mesh_repair.h"
#include "formats/mitsuba/scene_texts.h"
#include "libguide/scene/mesh_prepare.h"

namespace waylight {
namespace {

using testing::mentions;

class ShapesTest : public testing::MitsubaScenes {
 protected:
  // The only shape of a scene.
  Shape shape(const std::string& body, const std::string& version = "3.0.0") {
    warnings_.clear();
    const SceneDescription scene = import(body, version);
    EXPECT_EQ(scene.shapes.size(), 1u);
    return scene.shapes.at(0);
  }
  TriangleMesh mesh(const std::string& body, const std::string& version = "3.0.0") {
    return std::get<TriangleMesh>(shape(body, version).geometry);
  }
  void put_triangle() {
    put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.25\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  }
  static std::string file_shape(const std::string& type, const std::string& file,
                                const std::string& more = "") {
    return "<shape type=\"" + type + "\"><string name=\"filename\" value=\"" + file + "\"/>" +
           more + "</shape>";
  }
};

Vec3 normal_of(const TriangleMesh& mesh, size_t triangle) {
  const std::array<uint32_t, 3>& t = mesh.triangles[triangle];
  return triangle_normal(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
}

double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (const std::array<uint32_t, 3>& t : mesh.triangles)
    area += triangle_area(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
  return area;
}

void expect_outward(const TriangleMesh& mesh) {
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::array<uint32_t, 3>& t = mesh.triangles[i];
    const Vec3 middle = mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]];
    EXPECT_GT(normal_of(mesh, i).dot(middle), 0) << i;
  }
}

TEST_F(ShapesTest, RectangleFacesZAndHasItsTopRowAtMinusY) {
  const TriangleMesh rectangle = mesh("<shape type=\"rectangle\"/>");
  EXPECT_NEAR(area_of(rectangle), 4, 1e-6);
  EXPECT_EQ(normal_of(rectangle, 0), Vec3(0, 0, 1));
  EXPECT_EQ(normal_of(rectangle, 1), Vec3(0, 0, 1));
  EXPECT_EQ(rectangle.positions[0], Vec3(-1, -1, 0));
  EXPECT_EQ(rectangle.uvs[0], Vec2(0, 1));
}

TEST_F(ShapesTest, ReflectionKeepsTheOutsideOutside) {
  const std::string mirror = "<transform name=\"to_world\"><scale x=\"-1\"/></transform>";
  const TriangleMesh rectangle = mesh("<shape type=\"rectangle\">" + mirror + "</shape>");
  EXPECT_EQ(normal_of(rectangle, 0), Vec3(0, 0, 1));
  expect_outward(mesh("<shape type=\"cube\">" + mirror + "</shape>"));
}

TEST_F(ShapesTest, CubeIsClosedAndOutward) {
  const TriangleMesh cube = mesh("<shape type=\"cube\"/>");
  EXPECT_NEAR(area_of(cube), 24, 1e-5);
  expect_outward(cube);
}

// Mitsuba's src/shapes/cube.cpp, where v = 0 is the top row: per face the axes along which u and v
// rise.
TEST_F(ShapesTest, CubeHasTheTextureCoordinatesOfMitsuba) {
  const struct {
    Vec3 normal, u, v;
  } faces[] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},  {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
               {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}, {{0, -1, 0}, {0, 0, 1}, {1, 0, 0}},
               {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},   {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}};
  const TriangleMesh cube = mesh("<shape type=\"cube\"/>");
  for (size_t i = 0; i < cube.triangles.size(); ++i)
    for (const auto& face : faces)
      for (uint32_t corner : cube.triangles[i]) {
        if (normal_of(cube, i).dot(face.normal) < 0.5f) continue;
        const Vec3& p = cube.positions[corner];
        const Vec2 expected(0.5f * (1 + p.dot(face.u)), 1 - 0.5f * (1 + p.dot(face.v)));
        EXPECT_EQ(cube.uvs[corner], expected) << face.normal.transpose() << " at " << p.transpose();
      }
}

// Where azimuth is 0: along the first axis of coordinate_system(p1 - p0), of which the dialects
// have one each (src/libcore/util.cpp; include/mitsuba/core/vector.h).
TEST_F(ShapesTest, AzimuthOfACylinderBeginsWhereMitsubaHasIt) {
  const auto start = [&](const Vec3& axis, const std::string& version) {
    return mesh(fmt::format(R"(<shape type="cylinder"><point name="p1" x="{}" y="{}" z="{}"/>
                            </shape>)",
                            axis.x(), axis.y(), axis.z()),
                version)
        .positions[0];
  };
  const struct {
    Vec3 axis, old, current;
  } cases[] = {{{0, 0, 1}, {1, 0, 0}, {1, 0, 0}},
               {{0, 0, -1}, {1, 0, 0}, {1, 0, 0}},
               {{0, 1, 0}, {1, 0, 0}, {1, 0, 0}},
               {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
               {{0.6f, 0, 0.8f}, {0, -1, 0}, {0.8f, 0, -0.6f}},
               {{0, 0.6f, -0.8f}, {1, 0, 0}, {1, 0, 0}}};
  for (const auto& c : cases) {
    EXPECT_LT((start(c.axis, "0.6.0") - c.old).norm(), 1e-6f) << c.axis.transpose();
    EXPECT_LT((start(c.axis, "3.0.0") - c.current).norm(), 1e-6f) << c.axis.transpose();
  }
  const TriangleMesh tube = mesh("<shape type=\"cylinder\"/>");
  EXPECT_EQ(tube.uvs[0], Vec2(0, 1));
  EXPECT_LT((tube.positions[2 * 128] - Vec3(0, 1, 0)).norm(), 1e-6f);
  EXPECT_EQ(tube.uvs[2 * 128].x(), 0.25f);
}

TEST_F(ShapesTest, DiskAndCylinderHaveTheirAreas) {
  const TriangleMesh disk = mesh("<shape type=\"disk\"/>");
  EXPECT_NEAR(area_of(disk), kPi, 1e-4 * kPi);
  EXPECT_GT(normal_of(disk, 7).z(), 0.999f);
  const TriangleMesh tube = mesh(R"(<shape type="cylinder"><point name="p0" z="-1"/>
    <point name="p1" z="1"/><float name="radius" value="0.5"/></shape>)");
  EXPECT_NEAR(area_of(tube), 2 * kPi, 1e-3);
  expect_outward(tube);
}

TEST_F(ShapesTest, SphereStaysASphereUnderSimilarities) {
  const Shape sphere = shape(R"(<shape type="sphere"><point name="center" x="1"/>
    <float name="radius" value="0.5"/><transform name="to_world"><scale value="2"/>
    <rotate z="1" angle="90"/><translate z="3"/></transform>
    <boolean name="flip_normals" value="true"/></shape>)");
  const Sphere& geometry = std::get<Sphere>(sphere.geometry);
  EXPECT_NEAR(geometry.radius, 1, 1e-6f);
  EXPECT_LT((geometry.center - Vec3(0, 2, 3)).norm(), 1e-6f);
  EXPECT_LT((geometry.frame * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm(), 1e-6f);
  EXPECT_TRUE(sphere.flip_normals);
}

TEST_F(ShapesTest, SquashedSphereBecomesAMeshWithItsTextureCoordinates) {
  const std::string squash =
      "<shape type=\"sphere\"><transform name=\"to_world\"><scale x=\"2\"/></transform></shape>";
  const TriangleMesh ellipsoid = mesh(squash);
  expect_outward(ellipsoid);
  // Prolate spheroid, half axes 1 and 2: 2 pi (1 + 2 asin(e) / e), e^2 = 3/4.
  EXPECT_NEAR(area_of(ellipsoid), 21.4784, 0.01);
  EXPECT_EQ(ellipsoid.uvs[0].y(), 1);  // +z, which a Sphere finds at v = 1 too: its frame has -z
  const Shape round = shape("<shape type=\"sphere\"/>");
  EXPECT_EQ(std::get<Sphere>(round.geometry).frame * Vec3(0, 0, 1), Vec3(0, 0, -1));
}

TEST_F(ShapesTest, TextureCoordinatesFollowTheFormat) {
  put_triangle();
  EXPECT_EQ(mesh(file_shape("obj", "a.obj")).uvs[0], Vec2(0, 0.25f));
  const std::string raw = "<boolean name=\"flip_tex_coords\" value=\"false\"/>";
  EXPECT_EQ(mesh(file_shape("obj", "a.obj", raw)).uvs[0], Vec2(0, 0.75f));
  put("a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty float u\nproperty float v\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0 0 0.25\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
  EXPECT_EQ(mesh(file_shape("ply", "a.ply")).uvs[0], Vec2(0, 0.75f));
}

TEST_F(ShapesTest, NormalsAreMadeWhereTheFileHasNone) {
  put_triangle();
  EXPECT_EQ(mesh(file_shape("obj", "a.obj")).normals.size(), 3u);
  const std::string flat = "<boolean name=\"faceNormals\" value=\"true\"/>";
  EXPECT_TRUE(mesh(file_shape("obj", "a.obj", flat), "0.6.0").normals.empty());
}

TEST_F(ShapesTest, SmoothNormalsAreWeightedByAngle) {
  // A corner of a cube, one face of which is cut in two: by area or count it would lean.
  put("corner.obj",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 0\nf 1 3 5\nf 1 5 2\nf 1 2 4\nf 1 4 3\n");
  const TriangleMesh corner = mesh(file_shape("obj", "corner.obj"));
  EXPECT_LT((corner.normals[0] - Vec3(-1, -1, -1).normalized()).norm(), 1e-5f);
}

TEST_F(ShapesTest, NormalsGoByTheInverseTranspose) {
  put("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 1\nf 1//1 2//1 3//1\n");
  const TriangleMesh scaled =
      mesh(file_shape("obj", "n.obj", "<transform name=\"to_world\"><scale x=\"2\"/></transform>"));
  EXPECT_LT((scaled.normals[0] - Vec3(1, 0, 2).normalized()).norm(), 1e-6f);
  const TriangleMesh flat =
      mesh(file_shape("obj", "n.obj", "<transform name=\"to_world\"><scale z=\"0\"/></transform>"));
  EXPECT_LT((flat.normals[0] - Vec3(0, 0, 1)).norm(), 1e-6f);
}

TEST_F(ShapesTest, MissingMeshNamesWhoRefersToIt) {
  const std::string error = import_error(fmt::format("\n{}", file_shape("obj", "lost.obj")));
  EXPECT_TRUE(mentions(error, "scene.xml\":3: <shape type=\"obj\">")) << error;
  EXPECT_TRUE(mentions(error, "lost.obj")) << error;
  EXPECT_TRUE(mentions(import_error("<shape type=\"obj\"/>"), "filename"));
}

TEST_F(ShapesTest, DamagedMeshNamesMeshAndElement) {
  put("a.ply", "ply\nformat ascii 1.0\n");
  const std::string error = import_error(file_shape("ply", "a.ply"));
  EXPECT_TRUE(mentions(error, "scene.xml\":2") && mentions(error, "a.ply")) << error;
}

TEST_F(ShapesTest, PlyNumbersBeyondDoublePrecisionAreRefused) {
  const auto error = [&](const std::string& x) {
    put("a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
        "end_header\n0 0 0\n1 0 0\n0 " +
            x + " 0\n3 0 1 2\n");
    return import_error(file_shape("ply", "a.ply"));
  };
  EXPECT_EQ(error("1"), "no error");
  EXPECT_TRUE(mentions(error("1e400"), "\"1e400\" is no number"));
}

// The numbers of one element would be counted with those of the other.
TEST_F(ShapesTest, PlyWithTwoElementsOfANameIsRefused) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string normal = "property float nx\nproperty float ny\nproperty float nz\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\n" + xyz;
  put("two.ply", head + "element vertex 3\n" + xyz + normal + faces + "end_header\n" +
                     "0 0 0\n1 0 0\n0 1 0\n" + "0 0 1 0 0 1\n1 0 1 0 0 1\n0 1 1 0 0 1\n3 3 4 5\n");
  std::string error = import_error(file_shape("ply", "two.ply"));
  EXPECT_TRUE(mentions(error, "line 7 of the header: a second element \"vertex\"")) << error;
  put("two.ply", head + faces + faces + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n");
  error = import_error(file_shape("ply", "two.ply"));
  EXPECT_TRUE(mentions(error, "a second element \"face\"")) << error;
}

TEST_F(ShapesTest, MeshWithNormalsForSomeVerticesOnlyIsRefused) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.uvs.resize(2);
  EXPECT_TRUE(mentions(testing::error_of([&] { finish_mesh(mesh, "a.ply", nullptr); }),
                       "2 texture coordinates for 3 vertices"));
  mesh.uvs.clear();
  mesh.normals.resize(4);
  EXPECT_TRUE(mentions(testing::error_of([&] { finish_mesh(mesh, "a.ply", nullptr); }),
                       "4 normals for 3 vertices"));
}

TEST_F(ShapesTest, CoordinatesBeyondReasonNameTheShape) {
  const std::string far =
      "<transform name=\"to_world\"><translate x=\"1e30\"/></transform></shape>";
  put_triangle();
  for (const std::string& body :
       {std::string("<shape type=\"sphere\"><float name=\"radius\" value=\"1e30\"/></shape>"),
        "<shape type=\"sphere\">" + far, "<shape type=\"cube\">" + far,
        R"(<shape type="obj"><string name="filename" value="a.obj"/>)" + far,
        R"(<shape type="instance"><shape type="shapegroup"/>)" + far,
        std::string(R"(<shape type="instance"><transform name="to_world"><scale value="1e9"/>
            </transform><shape type="shapegroup"><shape type="sphere">
            <float name="radius" value="1e9"/></shape></shape></shape>)")}) {
    const std::string error = import_error("\n" + body);
    EXPECT_TRUE(mentions(error, "scene.xml\":3: <shape") && mentions(error, "1e+15")) << error;
  }
}

TEST_F(ShapesTest, RepairsAndIgnoredOptionsAreWarnings) {
  put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nf 1//1 2//1 3//1\n");
  shape(file_shape("obj", "a.obj", "<float name=\"max_smooth_angle\" value=\"30\"/>"));
  ASSERT_EQ(warnings_.size(), 3u);  // and no sensor
  EXPECT_TRUE(mentions(warnings_[0], "normals"));
  EXPECT_TRUE(mentions(warnings_[1], "max_smooth_angle"));
}

// Mitsuba 0.6 reads the materials of an OBJ file, later ones do not.
TEST_F(ShapesTest, MaterialsOfAnObjFileThatAreNotReadGetAWarning) {
  put("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  put("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n# usemtl red\nf 1 2 3\n");
  const auto warned = [&](const std::string& body, const std::string& version) {
    shape(body, version);
    return !warnings_.empty() && mentions(warnings_[0], "materials of its file are not read");
  };
  const auto load = [](const char* value) {
    return fmt::format("<boolean name=\"loadMaterials\" value=\"{}\"/>", value);
  };
  EXPECT_TRUE(warned(file_shape("obj", "a.obj"), "0.6.0"));
  EXPECT_TRUE(mentions(warnings_[0], "scene.xml\":2: <shape type=\"obj\">")) << warnings_[0];
  EXPECT_FALSE(warned(file_shape("obj", "a.obj"), "3.0.0"));
  EXPECT_FALSE(warned(file_shape("obj", "a.obj", load("false")), "0.6.0"));
  EXPECT_FALSE(warned(file_shape("obj", "a.obj", "<bsdf type=\"diffuse\"/>"), "0.6.0"));
  EXPECT_FALSE(warned(file_shape("obj", "plain.obj", load("true")), "0.6.0"));
}

TEST_F(ShapesTest, UnknownShapeIsAnErrorOrLeftOut) {
  const std::string error = import_error("<shape type=\"spehre\"/>");
  EXPECT_TRUE(mentions(error, "did you mean \"sphere\"")) << error;
  EXPECT_TRUE(mentions(import_error("<shape type=\"heightfield\"/>"), "known are obj, ply"));
  options_.lenient = true;
  EXPECT_TRUE(import("<shape type=\"heightfield\"/>").shapes.empty());
  EXPECT_TRUE(mentions(warnings_.at(0), "heightfield"));
}

TEST_F(ShapesTest, UnknownPropertyOfAShapeIsAnError) {
  const std::string error =
      import_error("<shape type=\"cube\">\n<transform name=\"to_wrold\"/></shape>");
  EXPECT_TRUE(mentions(error, ":3:") && mentions(error, "did you mean \"to_world\"")) << error;
}

TEST_F(ShapesTest, AreaLightKnowsItsShapeAndReflectsNothing) {
  const SceneDescription scene = import(R"(<shape type="cube"/><shape type="rectangle">
    <emitter type="area"><rgb name="radiance" value="1, 2, 3"/></emitter></shape>)");
  const AreaLight& light = std::get<AreaLight>(scene.emitters.at(0));
  EXPECT_EQ(light.shape, 1u);
  EXPECT_EQ(scene.shapes[1].emitter, 0);
  EXPECT_EQ(scene.shapes[0].emitter, kNone);
  EXPECT_TRUE((light.radiance.mean() == Color(1, 2, 3)).all());
  const Material& black = scene.materials.at(scene.shapes[1].material);
  EXPECT_TRUE(is_black(std::get<DiffuseMaterial>(black.model).reflectance.mean()));
}

TEST_F(ShapesTest, OneMaterialServesAllWhoReferToIt) {
  const SceneDescription scene =
      import(R"(<bsdf type="diffuse" id="a"/><bsdf type="diffuse" id="b"/>
    <shape type="cube"><ref id="a"/></shape><shape type="cube"><ref name="bsdf" id="a"/></shape>)");
  EXPECT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.shapes[0].material, scene.shapes[1].material);
  EXPECT_TRUE(mentions(import_error(R"(<bsdf type="diffuse" id="a"/><shape type="cube"><ref id="a"/>
    <bsdf type="diffuse"/></shape>)"),
                       "has 2 <bsdf>"));
}

TEST_F(ShapesTest, BoundaryWithoutBsdfIsNullInTheOldDialectAndGreyInTheNew) {
  const std::string body = R"(<medium type="homogeneous" id="m"/>
    <shape type="cube"><ref name="interior" id="m"/></shape>)";
  const SceneDescription old = import(body, "0.6.0"), current = import(body);
  EXPECT_EQ(old.shapes[0].interior_medium, 0);
  EXPECT_EQ(old.shapes[0].exterior_medium, kNone);
  EXPECT_TRUE(std::holds_alternative<NullMaterial>(old.materials[old.shapes[0].material].model));
  EXPECT_TRUE(
      std::holds_alternative<DiffuseMaterial>(current.materials[current.shapes[0].material].model));
}

TEST_F(ShapesTest, InstancesShareTheirGroup) {
  const SceneDescription scene = import(R"(
    <shape type="instance"><ref id="g"/></shape>
    <shape type="shapegroup" id="g"><shape type="cube"/><shape type="sphere"/></shape>
    <shape type="instance"><ref id="g"/>
      <transform name="to_world"><translate x="2"/></transform></shape>)");
  EXPECT_TRUE(scene.shapes.empty());
  EXPECT_EQ(scene.group_shapes.size(), 2u);
  ASSERT_EQ(scene.groups.size(), 1u);
  EXPECT_EQ(scene.groups[0].shapes, (std::vector<uint32_t>{0, 1}));
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].to_world(0, 3), 2);
}

TEST_F(ShapesTest, WhatCannotBeInstancedIsAnError) {
  EXPECT_TRUE(mentions(import_error("<shape type=\"instance\"/>"), "shapegroup"));
  EXPECT_TRUE(mentions(import_error(R"(<shape type="shapegroup" id="g"><shape type="cube">
    <emitter type="area"/></shape></shape>)"),
                       "cannot emit"));
  EXPECT_TRUE(mentions(import_error(R"(<shape type="shapegroup" id="g">
    <shape type="shapegroup"/></shape>)"),
                       "cannot contain"));
}

TEST_F(ShapesTest, ObjNumbersAreReadAsOthersWriteThem) {
  put("odd.obj",
      "\xef\xbb\xbf"
      "v +0 0 0 # first\r\nv 1e0 .0 0 0.5 0.5 0.5\nv\t0 1. 0\nvn nan nan nan\nvn 0 0 1\n"
      "f 1//1 2//2 -1//2 # a face\n");
  const TriangleMesh odd = mesh(file_shape("obj", "odd.obj"));
  EXPECT_EQ(odd.positions.size(), 3u);
  EXPECT_EQ(odd.positions[1], Vec3(1, 0, 0));
  EXPECT_TRUE(odd.normals[0].allFinite());
}

TEST_F(ShapesTest, ObjWordsThatAreNoNumbersAreRefusedWithTheirLine) {
  for (const char* line : {"v 1 xx 0", "v 1 1 inf", "v 1 1", "vt nan", "vn 0 1 z", "f 1 2 x",
                           "f 1.5 2 3", "f 1a 2 3", "f 1 2 4294967297"}) {
    put("bad.obj", fmt::format("v 0 0 0\nv 1 0 0\nv 0 1 0\n{}\nf 1 2 3\n", line));
    const std::string error = import_error(file_shape("obj", "bad.obj"));
    EXPECT_TRUE(mentions(error, "bad.obj\":4:")) << line << ": " << error;
  }
}

}  // namespace
}  // namespace waylight
