#!/usr/bin/env python3
"""Blue-noise remeshing from Python, by ctypes: needs nothing but libfpo_c.so.

    import fpo
    mesh = fpo.remesh(vertices, facets, 2000)   # lists (or arrays) of 3 coordinates and of 3 indices from 0
    mesh.vertices, mesh.facets, mesh.source_facet, mesh.barycentric, mesh.wanted, mesh.measures

The library is looked for in FPO_LIBRARY, beside this file, in ../build, then where the system has it. By itself,
`python3 fpo.py` remeshes a cube.
"""
import ctypes
import operator
import os
from types import SimpleNamespace

METHODS = {'fpo': 0, 'cvt': 1, 'mps': 2, 'cps': 3, 'pps': 4, 'ccst': 5, 'vbs': 6, 'hps': 7}
QUALITIES = {'best': 0, 'good': 1, 'draft': 2}
SIZINGS = {'uniform': 0, 'lfs': 1, 'curvature': 2}
SHEETS = {'auto': 0, 'apart': 1, 'together': 2}
SEARCHES = {'everywhere': 0, 'nearby': 1}
MEASURES = ('q_min', 'q_avg', 'theta_min', 'theta_max', 'delta', 'mean_delta')

Double, Int, Long = ctypes.c_double, ctypes.c_int32, ctypes.c_int64
Progress = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, Double, Double)


class Options(ctypes.Structure):
    """fpo_options of fpo/fpo_c.h."""
    _fields_ = [('count', Long), ('seed', ctypes.c_uint64), ('method', Int), ('sizing', Int),
                ('sizes', ctypes.POINTER(Double)), ('feature_angle', Double), ('threads', Int), ('iterations', Int),
                ('target_delta', Double), ('progress', Progress), ('user', ctypes.c_void_p), ('edge_length', Double),
                ('error', Double), ('quality', Int), ('radius', Double)]
    _fields_ += [(name, Int) for name in ('sheets', 'at_least', 'maximal', 'clean', 'mend', 'rest', 'ser',
                                          'corners_all', 'farthest_relative')]
    _fields_ += [(name, Double) for name in ('min_angle', 'min_delta', 'gradation', 'min_size', 'max_size',
                                             'weight_scale')]
    _fields_ += [('tile_samples', Long), ('search', Int), ('optimize_angles', Int), ('improve_fidelity', Int),
                 ('come_closer', Int), ('coarse_start', Int),
                 ('fixed', ctypes.POINTER(Double)), ('num_fixed', Long)]


# What remesh() takes by name; words where there is a table of them.
WORDS = {'method': METHODS, 'quality': QUALITIES, 'sheets': SHEETS, 'search': SEARCHES}
NAMES = [name for name, _ in Options._fields_
         if name not in ('count', 'sizing', 'sizes', 'progress', 'user', 'fixed', 'num_fixed')]


class Result(ctypes.Structure):
    """fpo_result of fpo/fpo_c.h."""
    _fields_ = ([('num_vertices', Long), ('num_facets', Long), ('vertices', ctypes.POINTER(Double)),
                 ('facets', ctypes.POINTER(Int)), ('source_facet', ctypes.POINTER(Int)),
                 ('barycentric', ctypes.POINTER(Double)), ('wanted', ctypes.POINTER(Double))]
                + [(name, Double) for name in MEASURES] + [('iterations', Int), ('same_topology', Int)])


def load_library():
    here = os.path.dirname(os.path.abspath(__file__))
    places = [os.environ.get('FPO_LIBRARY', ''), os.path.join(here, 'libfpo_c.so'),
              os.path.join(here, '..', 'build', 'libfpo_c.so')]
    library = ctypes.CDLL(next((place for place in places if os.path.exists(place)), 'libfpo_c.so'))
    library.fpo_default_options.restype = None
    library.fpo_free.restype = None
    library.fpo_remesh.argtypes = [ctypes.POINTER(Double), Long, ctypes.POINTER(Int), Long, ctypes.POINTER(Options),
                                   ctypes.POINTER(Result), ctypes.c_char_p, ctypes.c_size_t]
    return library


def index(number):
    number = operator.index(number)
    if not 0 <= number < 2**31:
        raise ValueError(f'{number} is no index of a vertex')
    return number


def flat(rows, kind):
    number_of = index if kind is Int else float
    numbers = [number_of(number) for row in rows for number in row]
    if len(numbers) != 3 * len(rows):
        raise ValueError('each row must have three numbers')
    return (kind * len(numbers))(*numbers)


def triples(pointer, count):
    return [tuple(pointer[3 * i:3 * i + 3]) for i in range(count)]


def remesh(vertices, facets, count=0, sizing='uniform', progress=None, fixed=None, **options):
    """Remeshes with `count` vertices, or by edge_length, error or radius. sizing: 'uniform', 'lfs', 'curvature' or a
    wanted edge length for each vertex. fixed: points that become vertices. progress(done, delta) stops the run by
    returning True; what it raises is raised. Other options are those of fpo_c.h by their names (NAMES), with words for numbers (WORDS):
    quality='draft', seed=7, at_least=True. Raises ValueError on what cannot be remeshed, KeyboardInterrupt if there
    was no result yet."""
    library = load_library()
    given = Options()
    library.fpo_default_options(ctypes.byref(given))
    given.count = count
    for name, value in options.items():
        if name not in NAMES:
            raise TypeError('there is no option ' + name)
        words = WORDS.get(name)
        if words and value not in words:
            raise ValueError(f'{name} is none of ' + ', '.join(words))
        setattr(given, name, words[value] if words else value)
    if fixed is not None and len(fixed) > 0:
        given.fixed, given.num_fixed = flat(fixed, Double), len(fixed)
    if isinstance(sizing, str):
        if sizing not in SIZINGS:
            raise ValueError('sizing is none of ' + ', '.join(SIZINGS))
        given.sizing = SIZINGS[sizing]
    else:
        if len(sizing) != len(vertices):
            raise ValueError('sizing must have a number for each vertex')
        given.sizing, given.sizes = 3, (Double * len(sizing))(*sizing)
    raised = []

    def report(user, done, delta):
        try:
            return 1 if progress(done, delta) else 0
        except BaseException as exception:  # Ctrl-C as well: it cannot go through the library
            raised.append(exception)
            return 1

    if progress:
        given.progress = Progress(report)
    result, error = Result(), ctypes.create_string_buffer(500)
    code = library.fpo_remesh(flat(vertices, Double), len(vertices), flat(facets, Int), len(facets),
                              ctypes.byref(given), ctypes.byref(result), error, len(error))
    try:
        if raised:
            raise raised[0]
        if code == 130 and result.num_vertices == 0:
            raise KeyboardInterrupt(error.value.decode())
        if code not in (0, 130):
            raise (ValueError if code == 2 else RuntimeError)(error.value.decode())
        n = result.num_vertices
        return SimpleNamespace(
            vertices=triples(result.vertices, n), facets=triples(result.facets, result.num_facets),
            source_facet=result.source_facet[:n], barycentric=triples(result.barycentric, n),
            wanted=result.wanted[:n], same_topology=bool(result.same_topology), interrupted=code == 130,
            iterations=result.iterations, measures={name: getattr(result, name) for name in MEASURES})
    finally:
        library.fpo_free(ctypes.byref(result))


def main():
    corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    facets = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4),
              (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]
    mesh = remesh(corners, facets, 500)
    print(f'vertices {len(mesh.vertices)}\ntriangles {len(mesh.facets)}\nleast angle {mesh.measures["theta_min"]:g}\n'
          f'same topology {int(mesh.same_topology)}')


if __name__ == '__main__':
    main()
