#include "libguide/scene/light_set.h"

#include "libguide/base/error.h"

namespace waylight {
namespace {

template <typename T>
concept Distant = requires(const T& emitter, const Vec3& w) {
  emitter.radiance(w);
};

// One emitter from its description.
struct MakeEmitter {
  const SceneDescription& scene;
  const SceneSphere& sphere;
  int index;

  Emitter operator()(const AreaLight& light) const {
    const Shape* shape = light.shape < scene.shapes.size() ? &scene.shapes[light.shape] : nullptr;
    if (!shape || shape->emitter != index)
      fail("emitter {}: its shape does not refer back to it; an area light belongs to one shape",
           index);
    if (const TriangleMesh* mesh = std::get_if<TriangleMesh>(&shape->geometry))
      return MeshEmitter(*mesh, light.radiance);
    return SphereEmitter(std::get<Sphere>(shape->geometry), shape->flip_normals, light.radiance);
  }
  Emitter operator()(const PointLight& light) const { return PointEmitter{light}; }
  Emitter operator()(const SpotLight& light) const {
    if (!(light.cutoff > 0 && light.cutoff <= kPi && light.beam_width <= light.cutoff))
      fail("emitter {}: a spot needs 0 < cutoff <= 180 degrees and beam width <= cutoff", index);
    return SpotEmitter{light};
  }
  Emitter operator()(const DirectionalLight& light) const {
    return DirectionalEmitter{light, sphere};
  }
  Emitter operator()(const ConstantEnvironment& light) const {
    return ConstantEmitter{light, sphere};
  }
  Emitter operator()(const EnvironmentMap& light) const {
    if (!light.bitmap || light.bitmap->pixels.empty())
      fail("emitter {}: its environment map has no pixels", index);
    return MapEmitter(light, sphere);
  }
  Emitter operator()(const DistantDisk& light) const {
    if (!(light.cos_angle >= -1 && light.cos_angle < 1))
      fail("emitter {}: a distant disk needs an angular radius above 0", index);
    return DiskEmitter{light, sphere};
  }
};

float checked_power(const Emitter& emitter, int index) {
  const double power = std::visit([](const auto& e) { return e.power(); }, emitter);
  if (!std::isfinite(static_cast<float>(power)) || power < 0)
    fail("emitter {}: its power is {}; its radiance must be finite and not negative", index, power);
  return static_cast<float>(power);
}

// Half uniform over the emitters that have power, half by power.
Discrete defensive(const std::vector<float>& powers, double total) {
  const auto active = std::count_if(powers.begin(), powers.end(), [](float p) { return p > 0; });
  std::vector<float> weights;
  for (const float p : powers)
    weights.push_back(p > 0 ? static_cast<float>(0.5 / active + 0.5 * p / total) : 0.0f);
  return Discrete(weights);
}

}  // namespace

LightSet::LightSet(const SceneDescription& scene, const SceneSphere& sphere) {
  std::vector<float> powers;
  emitters_.reserve(scene.emitters.size());
  for (int i = 0; i < static_cast<int>(scene.emitters.size()); ++i) {
    emitters_.push_back(std::visit(MakeEmitter{scene, sphere, i}, scene.emitters[i]));
    powers.push_back(checked_power(emitters_.back(), i));
    if (std::visit([]<typename T>(const T&) { return Distant<T>; }, emitters_.back()))
      distant_.push_back(i);
  }
  by_power_ = Discrete(powers);
  chosen_ = defensive(powers, by_power_.total());
}

bool LightSet::has_distant() const {
  for (int i = 0; i < static_cast<int>(emitters_.size()); ++i) {
    const bool distant = std::visit(
        []<typename T>(const T&) { return Distant<T> || std::is_same_v<T, DirectionalEmitter>; },
        emitters_[i]);
    if (distant && emission_prob(i) > 0) return true;
  }
  return false;
}

Color LightSet::environment(const Vec3& direction) const {
  Color sum = Color::Zero();
  for (const int i : distant_)
    std::visit(
        [&]<typename T>(const T& emitter) {
          if constexpr (Distant<T>) sum += emitter.radiance(direction);
        },
        emitters_[i]);
  return sum;
}

float LightSet::environment_pdf(const Vec3& direction) const {
  float sum = 0;
  for (const int i : distant_)
    if (chosen_.prob(i) > 0)
      std::visit(
          [&]<typename T>(const T& emitter) {
            if constexpr (Distant<T>) sum += chosen_.prob(i) * emitter.pdf(direction);
          },
          emitters_[i]);
  return sum;
}

std::optional<LightSample> LightSet::sample(const Vec3& from, float u, const Vec2& u2) const {
  if (chosen_.empty()) return std::nullopt;
  const Discrete::Sample chosen = chosen_.sample(u);
  return std::visit(
      [&]<typename T>(const T& emitter) {
        std::optional<LightSample> result = emitter.sample(from, chosen.u, u2);
        if (!result) return result;
        result->pdf *= chosen.prob;
        if constexpr (Distant<T>) {
          result->pdf = environment_pdf(result->wi);
          result->radiance = environment(result->wi);
          if (result->pdf <= 0) result.reset();
        }
        return result;
      },
      emitters_[chosen.index]);
}

float LightSet::pdf(const Vec3& from, const SurfacePoint& on_light, const Vec3& wi) const {
  const int i = on_light.emitter;
  if (i == kNone || chosen_.prob(i) <= 0) return 0;
  if (const MeshEmitter* mesh = std::get_if<MeshEmitter>(&emitters_[i]))
    return chosen_.prob(i) * mesh->pdf(from, on_light, wi);
  return chosen_.prob(i) * std::get<SphereEmitter>(emitters_[i]).pdf(from, on_light, wi);
}

std::optional<EmissionSample> LightSet::emit(float u, const Vec2& u_position,
                                             const Vec2& u_direction) const {
  if (by_power_.empty()) return std::nullopt;
  const Discrete::Sample chosen = by_power_.sample(u);
  std::optional<EmissionSample> result = emit(chosen.index, chosen.u, u_position, u_direction);
  if (result) result->power /= chosen.prob;
  return result;
}

std::optional<EmissionSample> LightSet::emit(int emitter, float u, const Vec2& u_position,
                                             const Vec2& u_direction) const {
  std::optional<EmissionSample> result = std::visit(
      [&](const auto& e) { return e.emit(u, u_position, u_direction); }, emitters_[emitter]);
  if (result) result->emitter = emitter;
  return result;
}

}  // namespace waylight
