#include "formats/mitsuba/parse_value.h"

namespace waylight::mitsuba {
namespace {

using Matrix = Eigen::Matrix4d;  // products of many steps keep the precision of the file
using Vector = Eigen::Vector3d;

Matrix translate(const Element& step) {
  Matrix result = Matrix::Identity();
  result.topRightCorner<3, 1>() = parse_vector(step, Vector::Zero());
  return result;
}

Matrix scale(const Element& step) {
  Matrix result = Matrix::Identity();
  result.diagonal().head<3>() = parse_vector(step, Vector::Ones());
  return result;
}

Matrix rotate(const Element& step) {
  const Vector axis = parse_vector(step, Vector::Zero());
  const double angle = parse_number(step, required_attribute(step, "angle"));
  if (!(axis.norm() > 0)) fail_at(step, "needs an axis: x, y or z");
  Matrix result = Matrix::Identity();
  result.topLeftCorner<3, 3>() =
      Eigen::AngleAxisd(angle * std::numbers::pi / 180, axis.normalized()).toRotationMatrix();
  return result;
}

Vector triple(const Element& step, const std::string& key) {
  const std::vector<double> numbers = parse_numbers(step, required_attribute(step, key));
  if (numbers.size() != 3)
    fail_at(step, "\"{}\" has {} numbers, 3 are needed", key, numbers.size());
  return {numbers[0], numbers[1], numbers[2]};
}

// Some direction far from parallel to a unit vector.
Vector any_up(const Vector& forward) {
  return std::abs(forward.y()) < 0.9 ? Vector::UnitY() : Vector::UnitZ();
}

// Columns left, up, forward, origin. An `up` that is missing, zero or along the line of sight
// leaves the roll open: any is taken, as Mitsuba does.
Matrix look_at(const Element& step) {
  const Vector origin = triple(step, "origin");
  Vector forward = triple(step, "target") - origin;
  if (!(forward.norm() > 0)) fail_at(step, "its origin and its target are the same point");
  forward.normalize();
  Vector up = step.attribute("up") ? triple(step, "up") : Vector(Vector::Zero());
  if (!(up.cross(forward).norm() > 1e-9 * up.norm())) up = any_up(forward);
  const Vector left = up.cross(forward).normalized();
  Matrix result = Matrix::Identity();
  result.topRows<3>() << left, forward.cross(left), forward, origin;
  return result;
}

// 4 x 4 row by row, or 3 x 3 without translation.
Matrix matrix(const Element& step) {
  const std::vector<double> numbers = parse_numbers(step, required_attribute(step, "value"));
  const int n = numbers.size() == 16 ? 4 : 3;
  if (numbers.size() != 16 && numbers.size() != 9)
    fail_at(step, "has {} numbers, 16 or 9 are needed", numbers.size());
  Matrix result = Matrix::Identity();
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) result(row, column) = numbers[row * n + column];
  if (!result.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1)))
    fail_at(step, "its last row must be 0 0 0 1: perspective is not supported here");
  return result;
}

Matrix parse_step(const Element& step) {
  if (step.tag == "translate") return translate(step);
  if (step.tag == "scale") return scale(step);
  if (step.tag == "rotate") return rotate(step);
  if (step.tag == "lookat") return look_at(step);
  return matrix(step);
}

}  // namespace

Mat4 parse_transform(const Element& element) {
  Matrix product = Matrix::Identity();
  for (const Element& step : element.children) {
    const Matrix next = parse_step(step) * product;
    product = next;
  }
  const Mat4 result = product.cast<float>();
  if (!result.allFinite()) fail_at(element, "its product is not finite");
  return result;
}

}  // namespace waylight::mitsuba
