// The library as others use it: a cube of twelve triangles gets 500 vertices.
#include <fpo/fpo.h>

#include <iostream>

int main() {
  Eigen::MatrixXd V(8, 3);
  for (int v = 0; v < 8; ++v) V.row(v) << (v & 1), (v >> 1 & 1), (v >> 2);
  Eigen::MatrixXi F(12, 3);
  F << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1,
      7, 5;
  fpo::Options options;
  options.count = 500;
  const fpo::Remesh remesh = fpo::remesh(V, F, options);
  std::cout << "vertices " << remesh.V.rows() << "\ntriangles " << remesh.F.rows() << "\nleast angle "
            << remesh.measures.quality.theta_min << "\nsame topology " << remesh.measures.same_topology()
            << "\nbox " << remesh.V.colwise().minCoeff() << " to " << remesh.V.colwise().maxCoeff() << "\n";
}
