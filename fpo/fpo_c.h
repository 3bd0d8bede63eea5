#pragma once
/* The front door in C (fpo.h is the same in C++): plain arrays, and errors as text. Left out, everything is
   as fpo-remesh does it. */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { fpo_done = 0, fpo_bad_input = 2, fpo_bug = 70, fpo_interrupted = 130 };
enum {
  fpo_method_fpo = 0,
  fpo_method_cvt = 1,
  fpo_method_mps = 2,
  fpo_method_cps = 3,
  fpo_method_pps = 4,
  fpo_method_ccst = 5,
  fpo_method_vbs = 6,
  fpo_method_hps = 7
};
enum { fpo_sizing_uniform = 0, fpo_sizing_lfs = 1, fpo_sizing_curvature = 2, fpo_sizing_given = 3 };

enum { fpo_quality_best = 0, fpo_quality_good = 1, fpo_quality_draft = 2 };
enum { fpo_sheets_auto = 0, fpo_sheets_apart = 1, fpo_sheets_together = 2 };
enum { fpo_by_default = -1, fpo_no = 0, fpo_yes = 1 }; /* where the default depends on other options */
enum { fpo_search_everywhere = 0, fpo_search_nearby = 1 };

typedef struct fpo_options {
  int64_t count; /* vertices of the remesh; 0: by lengths */
  uint64_t seed;
  int32_t method, sizing; /* see above */
  const double*
      sizes; /* if given: a wanted edge length for each vertex, up to a factor; else not looked at */
  double feature_angle; /* folds by more degrees are kept; 0: none, negative: creases of machined parts */
  int32_t threads;      /* at most, up to 1024; 0: all cores; no matter to the result */
  int32_t iterations;   /* at most; negative: as many as are best */
  double target_delta;  /* stop when the least spacing exceeds it; negative: what the quality says */
  /* Called every some hundred moves with the share of them that is done and the last iteration's delta; if it
     returns anything but 0, the moves so far are the result. Null: nobody. */
  int (*progress)(void* user, double done, double delta);
  void* user;
  double edge_length, error; /* instead of a count: wanted mean edge, distance from the input; 0: not given */
  int32_t quality;           /* how long */
  double radius;             /* likewise, of the disks of mps and cps; 0: not given */
  int32_t sheets;
  int32_t at_least;            /* 1: more than `count`, about as many as it takes for the input's type */
  int32_t maximal;             /* 1: in the end samples are moved until their disks cover the surface */
  int32_t clean, mend;         /* 0: facets as they are; 0: samples stay where the remesh is no surface */
  int32_t rest, ser;           /* 1: samples rest where the target is met; 1: shortest edge removal first */
  int32_t corners_all;         /* 1: farthest points may be on corners of all types */
  int32_t farthest_relative;   /* 1: the farthest point is the largest circle for the wanted length there */
  double min_angle, min_delta; /* wanted by angle optimization, degrees; what it may pay; negative: default */
  double gradation;            /* wanted lengths change by so much per length; negative: default */
  double min_size, max_size;   /* of wanted lengths, in even spacings; negative: default */
  double weight_scale;         /* a sample's weight is (this times the wanted length)^2; negative: default */
  int64_t tile_samples;        /* at most, in a tile; 0: no tiles; negative: default */
  int32_t search;              /* everywhere, nearby, or fpo_by_default */
  int32_t optimize_angles, improve_fidelity, come_closer; /* fpo_no, fpo_yes, fpo_by_default */
  int32_t coarse_start; /* 0: all iterations on the surface itself, be there dozens of facets a sample */
  const double* fixed;  /* x, y, z of points of the surface that become the first vertices; may be null */
  int64_t num_fixed;
} fpo_options;

/* Facets and vertices count from 0. Arrays belong to the library, until fpo_free(). */
typedef struct fpo_result {
  int64_t num_vertices, num_facets;
  double* vertices;      /* x, y, z of each */
  int32_t* facets;       /* three vertices each, counterclockwise seen from outside */
  int32_t* source_facet; /* of each vertex: the facet of the input in which it lies */
  double* barycentric;   /* and its three coordinates there */
  double* wanted;        /* of each vertex: the wanted edge length */
  double q_min, q_avg, theta_min, theta_max, delta, mean_delta; /* as fpo-quality has them; degrees */
  int32_t iterations;
  int32_t same_topology; /* 1: a 2-manifold of the input's topological type */
} fpo_result;

/* The options of fpo-remesh; the count is 0: it or a length must be set. */
void fpo_default_options(fpo_options* options);

/* Remeshes a surface of so many vertices (x, y, z each) and triangles (three vertices each, from 0). Returns
   fpo_done, fpo_bad_input, fpo_bug, or fpo_interrupted: then the result is that of the moves so far, or empty
   if there was none yet. Other failures leave the result empty. The error is one line, cut to error_size
   bytes with its end, and empty if there is none; it may be null. Other pointers that are null are bad
   input. */
int fpo_remesh(const double* vertices, int64_t num_vertices, const int32_t* facets, int64_t num_facets,
               const fpo_options* options, fpo_result* result, char* error, size_t error_size);

/* Frees the arrays and leaves the result empty. Of null: nothing. */
void fpo_free(fpo_result* result);

#ifdef __cplusplus
}
#endif
