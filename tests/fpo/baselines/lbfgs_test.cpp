#include "fpo/baselines/lbfgs.h"

#include "doctest.h"
#include "geom/rng.h"

using namespace fpo;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

VectorXd random_vector(int size, geom::Rng& rng) {
  VectorXd v(size);
  for (int i = 0; i < size; ++i) v[i] = rng.uniform(-1, 1);
  return v;
}

/// Positive definite.
MatrixXd random_hessian(int size, geom::Rng& rng) {
  MatrixXd a(size, size);
  for (int i = 0; i < size; ++i) a.col(i) = random_vector(size, rng);
  return a * a.transpose() + MatrixXd::Identity(size, size);
}

}  // namespace

TEST_CASE("lbfgs: without memory the direction is that of steepest descent, scaled") {
  const LbfgsMemory memory(5);
  CHECK(memory.direction(Vector2d(1, -2), Vector2d(0.5, 3)) == Vector2d(-0.5, 6));
}

TEST_CASE("lbfgs: the last step is what the last change of the gradient calls for; descent in any case") {
  geom::Rng rng(3);
  for (int trial = 0; trial < 20; ++trial) {
    LbfgsMemory memory(4);
    const MatrixXd hessian = random_hessian(8, rng);
    VectorXd s;
    for (int k = 0; k < 7; ++k) {
      s = random_vector(8, rng);
      memory.push(s, hessian * s);
    }
    const VectorXd scale = VectorXd::Constant(8, 0.3);
    CHECK((memory.direction(hessian * s, scale) + s).norm() < 1e-9 * s.norm());  // H y = s
    const VectorXd gradient = random_vector(8, rng);
    CHECK(memory.direction(gradient, scale).dot(gradient) < 0);
  }
}

TEST_CASE("lbfgs: a step without positive curvature is not remembered, nor one too many") {
  LbfgsMemory memory(1);
  memory.push(Vector2d(1, 0), Vector2d(-1, 0));
  memory.push(Vector2d(1, 0), Vector2d(0, 1));
  CHECK(memory.empty());
  memory.push(Vector2d(1, 0), Vector2d(4, 0));
  memory.push(Vector2d(0, 1), Vector2d(0, 2));
  // Only the second: a multiple 1/2 of the identity.
  CHECK((memory.direction(Vector2d(3, 5), Vector2d(1, 1)) - Vector2d(-1.5, -2.5)).norm() < 1e-12);
}

TEST_CASE(
    "lbfgs: with exact steps it reaches the minimum of a quadratic form in as many steps as it has "
    "variables") {
  geom::Rng rng(7);
  const MatrixXd hessian = random_hessian(10, rng);
  const VectorXd minimum = random_vector(10, rng);
  VectorXd x = VectorXd::Zero(10);
  LbfgsMemory memory(10);
  for (int k = 0; k < 10; ++k) {
    const VectorXd gradient = hessian * (x - minimum);
    const VectorXd d = memory.direction(gradient, VectorXd::Ones(10));
    const VectorXd s = -gradient.dot(d) / d.dot(hessian * d) * d;
    memory.push(s, hessian * s);
    x += s;
  }
  CHECK((x - minimum).norm() < 1e-6);
}
