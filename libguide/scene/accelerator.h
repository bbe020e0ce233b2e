#pragma once
// Embree behind two questions. Primitives and instances keep the order of the description.

#include <memory>
#include <optional>
#include <vector>

#include "libguide/scene/scene_description.h"

namespace waylight {

struct Hit {
  float t;
  float u, v;  // barycentric coordinates of the second and third corner of a triangle
  uint32_t primitive;
  uint32_t shape;        // index into shapes, or group_shapes when instanced
  int instance = kNone;  // index into instances
};

// Which surfaces a ray can meet.
enum RayMask : uint32_t { kOpaque = 1, kTransparent = 2, kEverything = 3 };

class Accelerator {
 public:
  // Keeps pointers into the description. transparent[m]: whether opacity of material m can be below
  // one. placed[i]: whether instance i is built.
  Accelerator(const SceneDescription& scene, const std::vector<bool>& transparent,
              const std::vector<bool>& placed);
  ~Accelerator();
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;

  std::optional<Hit> intersect(const Ray& ray, RayMask mask) const;
  bool occluded(const Ray& ray, RayMask mask) const;
  bool has_transparent() const { return has_transparent_; }

 private:
  struct Handles;
  const SceneDescription& scene_;
  bool has_transparent_ = false;
  std::unique_ptr<Handles> handles_;
};

}  // namespace waylight
