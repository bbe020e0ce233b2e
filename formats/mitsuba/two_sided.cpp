// Two sides for scenes exported from renderers that ignore the orientation of surfaces.

#include <set>

#include "formats/mitsuba/materials.h"

namespace waylight::mitsuba {
namespace {

class TwoSides {
 public:
  explicit TwoSides(SceneDescription& scene) : materials_(scene.materials) {}

  void give_to(const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes)
      if (shape.material != kNone) give_to(shape.material);
  }

 private:
  void give_to(int index) {
    if (!seen_.insert(index).second) return;
    const MaterialModel& model = materials_[index].model;
    if (std::holds_alternative<TwoSidedMaterial>(model) || is_interface(model)) return;
    const std::vector<int> nested = parts(model);
    if (nested.empty()) return wrap(index);
    for (const int part : nested) give_to(part);
  }

  // The wrapper takes the index and the name, so all that refers to them stays as it is.
  void wrap(int index) {
    const int inside = static_cast<int>(materials_.size());
    materials_.push_back(Material(materials_[index]));
    materials_[index].model = TwoSidedMaterial{inside, inside};
  }

  std::vector<Material>& materials_;
  std::set<int> seen_;
};

}  // namespace

void make_two_sided(SceneDescription& scene) {
  TwoSides sides(scene);
  sides.give_to(scene.shapes);
  sides.give_to(scene.group_shapes);
}

}  // namespace waylight::mitsuba
