#pragma once
// A scene as plain data, as importers make it: indices instead of names, transforms applied.

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "libguide/bsdf/material.h"
#include "libguide/image/texture.h"
#include "libguide/medium/medium.h"
#include "libguide/records/scene_hash.h"

namespace waylight {

inline constexpr int kNone = -1;

struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  // empty (face normals) or one per position, unit length
  std::vector<Vec2> uvs;      // empty or one per position
  std::vector<std::array<uint32_t, 3>> triangles;
};

// Parameterised like Mitsuba's: u is azimuth about z / 2 pi, v is polar angle / pi, in the frame.
struct Sphere {
  Vec3 center = Vec3::Zero();
  float radius = 1;
  Mat3 frame = Mat3::Identity();  // orthogonal: from the sphere's own axes to the world
};

struct Shape {
  std::string name;
  std::variant<TriangleMesh, Sphere> geometry;
  int material = kNone;         // index into materials
  int emitter = kNone;          // index into emitters when this shape is an area light
  int interior_medium = kNone, exterior_medium = kNone;
  bool flip_normals = false;
};

// Shapes of a group are in the group's own space and seen only through instances.
struct ShapeGroup {
  std::vector<uint32_t> shapes;  // indices into SceneDescription::group_shapes
};
struct Instance {
  uint32_t group = 0;
  Mat4 to_world = Mat4::Identity();
};

struct AreaLight {
  Texture radiance;  // W / (m^2 sr), emitted on the side of the geometric normal
  uint32_t shape = 0;
};
struct PointLight {
  Vec3 position;
  Color intensity;  // W / sr
};
struct SpotLight {
  Vec3 position;
  Vec3 direction;  // unit
  Color intensity;
  float cutoff = 0, beam_width = 0;  // radians from the axis; smooth between the two
};
struct DirectionalLight {
  Vec3 direction;    // unit, the way light travels
  Color irradiance;  // W/m^2 on a surface perpendicular to it
};
struct ConstantEnvironment {
  Color radiance;
};
// Equirectangular, Mitsuba's convention: in the map's own axes y is up (top row of the picture) and
// the direction of column u is (sin(2 pi u), ., -cos(2 pi u)).
struct EnvironmentMap {
  std::shared_ptr<const Bitmap> bitmap;
  float scale = 1;
  Mat3 to_world = Mat3::Identity();  // rotation
  // Mitsuba's new dialect: the centres of the first and the last row are the poles. Else these lie
  // half a pixel beyond.
  bool rows_at_poles = false;
};
// A distant uniform disk, such as the sun.
struct DistantDisk {
  Vec3 to_light;         // unit, towards its centre
  float cos_angle = 1;   // of its angular radius
  Color radiance;
};

using EmitterDescription = std::variant<AreaLight, PointLight, SpotLight, DirectionalLight,
                                        ConstantEnvironment, EnvironmentMap, DistantDisk>;

enum class FilterType { box, tent, gaussian, mitchell };

struct FilmDescription {
  int width = 768, height = 576;
  // Crop window in pixels.
  int crop_x = 0, crop_y = 0, crop_width = 0, crop_height = 0;  // crop_width 0: no crop
  FilterType filter = FilterType::gaussian;
  float filter_radius = 0;     // pixels; 0: the filter's default
  float filter_stddev = 0.5f;  // gaussian
  float filter_b = 1.0f / 3, filter_c = 1.0f / 3;  // mitchell
};

// What a field of view spans of the film: its width, its height, its diagonal, or the smaller or
// the larger side.
enum class FovAxis { x, y, diagonal, smaller, larger };

// Perspective camera looking along +z of its own space with y up and x to the LEFT (Mitsuba).
struct SensorDescription {
  Mat4 to_world = Mat4::Identity();  // no scale
  float fov = 0.785398f;             // radians, of the full film, whatever its size
  FovAxis fov_axis = FovAxis::x;
  float aperture_radius = 0;         // thin lens; 0: pinhole
  float focus_distance = 1;
  float principal_x = 0, principal_y = 0;  // offset of the principal point, fraction of the film
  int medium = kNone;
  FilmDescription film;
};

struct IntegratorDefaults {
  int max_depth = -1;  // Mitsuba's: path edges, 1 shows emitters only; -1 unlimited
  int rr_depth = 5;    // vertices before roulette begins
  bool hide_emitters = false;
};

struct SceneDescription {
  std::vector<Shape> shapes;
  std::vector<Shape> group_shapes;
  std::vector<ShapeGroup> groups;
  std::vector<Instance> instances;
  std::vector<Material> materials;
  std::vector<EmitterDescription> emitters;
  std::vector<Medium> media;
  SensorDescription sensor;
  IntegratorDefaults integrator;
  SceneHash hash;
  std::string source;  // file name as given, for messages only
};

}  // namespace waylight
