#include "formats/scene_hash.h"

#include "formats/value_hash.h"

// Structs are taken apart by structured bindings, which do not compile any more when a field is
// added: none is forgotten.

namespace waylight {
namespace {

template <typename... Models>
void add(ValueHash& hash, const std::variant<Models...>& variant);

void add(ValueHash& hash, const TriangleMesh& mesh) {
  const auto& [positions, normals, uvs, triangles] = mesh;
  hash.add_all(positions, normals, uvs, triangles);
}

void add(ValueHash& hash, const Sphere& sphere) {
  const auto& [center, radius, frame] = sphere;
  hash.add_all(center, radius, frame);
}

void add(ValueHash& hash, const DiffuseMaterial& m) {
  const auto& [reflectance] = m;
  hash.add_all(reflectance);
}

void add(ValueHash& hash, const ConductorMaterial& m) {
  const auto& [eta, k, reflectance] = m;
  hash.add_all(eta, k, reflectance);
}

void add(ValueHash& hash, const RoughConductorMaterial& m) {
  const auto& [eta, k, reflectance, alpha_u, alpha_v, distribution] = m;
  hash.add_all(eta, k, reflectance, alpha_u, alpha_v, distribution);
}

void add(ValueHash& hash, const DielectricMaterial& m) {
  const auto& [eta, reflectance, transmittance] = m;
  hash.add_all(eta, reflectance, transmittance);
}

void add(ValueHash& hash, const ThinDielectricMaterial& m) {
  const auto& [eta, reflectance, transmittance] = m;
  hash.add_all(eta, reflectance, transmittance);
}

void add(ValueHash& hash, const RoughDielectricMaterial& m) {
  const auto& [eta, reflectance, transmittance, alpha_u, alpha_v, distribution] = m;
  hash.add_all(eta, reflectance, transmittance, alpha_u, alpha_v, distribution);
}

void add(ValueHash& hash, const PlasticMaterial& m) {
  const auto& [eta, nonlinear, diffuse, specular] = m;
  hash.add_all(eta, nonlinear, diffuse, specular);
}

void add(ValueHash& hash, const RoughPlasticMaterial& m) {
  const auto& [eta, nonlinear, diffuse, specular, alpha, distribution] = m;
  hash.add_all(eta, nonlinear, diffuse, specular, alpha, distribution);
}

void add(ValueHash& hash, const PhongMaterial& m) {
  const auto& [diffuse, specular, exponent] = m;
  hash.add_all(diffuse, specular, exponent);
}

void add(ValueHash& hash, const WardMaterial& m) {
  const auto& [variant, diffuse, specular, alpha_u, alpha_v] = m;
  hash.add_all(variant, diffuse, specular, alpha_u, alpha_v);
}

void add(ValueHash&, const NullMaterial&) {}

void add(ValueHash& hash, const TwoSidedMaterial& m) {
  const auto& [front, back] = m;
  hash.add_all(front, back);
}

void add(ValueHash& hash, const MaskMaterial& m) {
  const auto& [nested, opacity] = m;
  hash.add_all(nested, opacity);
}

void add(ValueHash& hash, const BlendMaterial& m) {
  const auto& [first, second, weight] = m;
  hash.add_all(first, second, weight);
}

void add(ValueHash& hash, const BumpMapMaterial& m) {
  const auto& [nested, height] = m;
  hash.add_all(nested, height);
}

void add(ValueHash& hash, const NormalMapMaterial& m) {
  const auto& [nested, normals] = m;
  hash.add_all(nested, normals);
}

void add(ValueHash& hash, const AreaLight& e) {
  const auto& [radiance, shape] = e;
  hash.add_all(radiance, shape);
}

void add(ValueHash& hash, const PointLight& e) {
  const auto& [position, intensity] = e;
  hash.add_all(position, intensity);
}

void add(ValueHash& hash, const SpotLight& e) {
  const auto& [position, direction, intensity, cutoff, beam_width] = e;
  hash.add_all(position, direction, intensity, cutoff, beam_width);
}

void add(ValueHash& hash, const DirectionalLight& e) {
  const auto& [direction, irradiance] = e;
  hash.add_all(direction, irradiance);
}

void add(ValueHash& hash, const ConstantEnvironment& e) {
  const auto& [radiance] = e;
  hash.add_all(radiance);
}

void add(ValueHash& hash, const EnvironmentMap& e) {
  const auto& [bitmap, scale, to_world, rows_at_poles] = e;
  hash.add_all(bitmap, scale, to_world);
  if (rows_at_poles) hash.add_all(rows_at_poles);
}

void add(ValueHash& hash, const DistantDisk& e) {
  const auto& [to_light, cos_angle, radiance] = e;
  hash.add_all(to_light, cos_angle, radiance);
}

void add(ValueHash& hash, const HomogeneousMedium& m) {
  const auto& [sigma_t, albedo] = m;
  hash.add_all(sigma_t, albedo);
}

void add(ValueHash& hash, const HeterogeneousMedium& m) {
  const auto& [density, albedo, scale] = m;
  hash.add_all(density, albedo, scale);
}

// Media without emission have the hashes that they had before there was any.
void add(ValueHash& hash, const MediumEmission& emission) {
  const auto& [radiance, scale] = emission;
  if (emits(emission)) hash.add_all(radiance, scale);
}

void add(ValueHash&, const IsotropicPhase&) {}

void add(ValueHash& hash, const HenyeyGreenstein& phase) {
  const auto& [g] = phase;
  hash.add_all(g);
}

template <typename... Models>
void add(ValueHash& hash, const std::variant<Models...>& variant) {
  hash.add(variant.index());
  std::visit([&](const auto& model) { add(hash, model); }, variant);
}

// Which material a shape has belongs to the geometry: fits of BSDFs do not depend on it. Its light
// is told by the emitters, its media with the media.
void add_geometry(ValueHash& hash, const std::vector<Shape>& shapes) {
  hash.add(shapes.size());
  for (const Shape& shape : shapes) {
    const auto& [name, geometry, material, emitter, interior, exterior, flip_normals] = shape;
    add(hash, geometry);
    hash.add_all(material, flip_normals);
  }
}

uint64_t hash_geometry(const SceneDescription& scene, SharedHashes& shared) {
  ValueHash hash(shared);
  add_geometry(hash, scene.shapes);
  add_geometry(hash, scene.group_shapes);
  hash.add(scene.groups.size());
  for (const ShapeGroup& group : scene.groups) hash.add(group.shapes);
  hash.add(scene.instances.size());
  for (const Instance& instance : scene.instances) hash.add_all(instance.group, instance.to_world);
  return hash.value();
}

uint64_t hash_materials(const SceneDescription& scene, SharedHashes& shared) {
  ValueHash hash(shared);
  hash.add(scene.materials.size());
  for (const Material& material : scene.materials) add(hash, material.model);
  return hash.value();
}

uint64_t hash_emitters(const SceneDescription& scene, SharedHashes& shared) {
  ValueHash hash(shared);
  hash.add(scene.emitters.size());
  for (const EmitterDescription& emitter : scene.emitters) add(hash, emitter);
  return hash.value();
}

uint64_t hash_media(const SceneDescription& scene, SharedHashes& shared) {
  ValueHash hash(shared);
  hash.add(scene.media.size());
  for (const Medium& medium : scene.media) {
    add(hash, medium.coefficients);
    add(hash, medium.phase);
    add(hash, medium.emission);
  }
  for (const auto* shapes : {&scene.shapes, &scene.group_shapes})
    for (const Shape& shape : *shapes) hash.add_all(shape.interior_medium, shape.exterior_medium);
  return hash.value();
}

}  // namespace

SceneHash hash_scene(const SceneDescription& scene) {
  SharedHashes shared;
  return {.geometry = hash_geometry(scene, shared),
          .materials = hash_materials(scene, shared),
          .emitters = hash_emitters(scene, shared),
          .media = hash_media(scene, shared)};
}

}  // namespace waylight
