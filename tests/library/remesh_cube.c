/* The same in C. */
#include <fpo/fpo_c.h>
#include <stdio.h>

int main(void) {
  const double vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
  const int32_t facets[] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                            2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  char error[200];
  fpo_options options;
  fpo_result result;
  fpo_default_options(&options);
  options.count = 500;
  if (fpo_remesh(vertices, 8, facets, 12, &options, &result, error, sizeof error) != fpo_done) {
    fprintf(stderr, "%s\n", error);
    return 1;
  }
  printf("vertices %lld\ntriangles %lld\nleast angle %g\nsame topology %d\n", (long long)result.num_vertices,
         (long long)result.num_facets, result.theta_min, result.same_topology);
  fpo_free(&result);
  return 0;
}
