#pragma once
// Everything a run needs, checked once against the scene, const from then on.

#include <algorithm>
#include <complex>
#include <cstddef>
#include <vector>

#include "core/contract.h"
#include "propagation/laws/slab_table.h"
#include "propagation/plan_file.h"
#include "propagation/small_object.h"
#include "scenes/scene.h"

namespace grimaldi {

class Tracer;

/// A face's material at every band of the run.
struct FaceMaterial {
  std::vector<std::complex<double>> permittivity;  ///< radio: ε' − jε'', per band
  double thickness = 0;                            ///< m; infinity = half-space
  std::vector<SlabTable> slab;                     ///< radio: reflection, per band
  std::vector<double> absorption;                  ///< sound: α per band
};

/// The grid of cells: ceil(size/cell_size) cells a side, centred on the area; row-major, x fastest, south to north.
struct GridLayout {
  std::size_t nx = 0, ny = 0;
  double x0 = 0, y0 = 0;  ///< south-west corner, m
  double cell = 1;        ///< side, m
  double z = 0;           ///< height of the receivers above local zero, m
  std::size_t size() const { return nx * ny; }
  /// act(cell) for the cell and the up to eight around it, in the order of their numbers.
  template <typename Act>
  void each_near(std::size_t cell_index, const Act& act) const {
    const std::size_t x = cell_index % nx, y = cell_index / nx;
    for (std::size_t j = y > 0 ? y - 1 : y; j <= std::min(y + 1, ny - 1); ++j)
      for (std::size_t i = x > 0 ? x - 1 : x; i <= std::min(x + 1, nx - 1); ++i) act(j * nx + i);
  }
  Vec3 centre(std::size_t cell_index) const {
    return {x0 + (double(cell_index % nx) + 0.5) * cell, y0 + (double(cell_index / nx) + 0.5) * cell, z};
  }
};

struct Plan {
  PlanDescription request;              ///< what was asked, in SI units
  double speed = 0;                     ///< of the wave, m/s
  std::vector<double> frequency;        ///< Hz, ascending
  std::vector<double> wavenumber;       ///< rad/m, per band
  std::vector<double> attenuation;      ///< of the air, Np/m of amplitude, per band (0 for radio)
  std::vector<FaceMaterial> materials;  ///< per material of the scene
  GridLayout grid;                      ///< empty (nx = 0) without coverage
  SmallObjects small_objects;           ///< those that may scatter as a whole; none but under `auto`
  std::size_t bands() const { return frequency.size(); }
  std::size_t polarisations() const { return request.kind == WaveKind::radio ? 2 : 1; }
};

/// Edges along one path at the most: the depth, what the plan allows and what a path can hold (`max_edges`); 0 without
/// diffraction.
int most_edges(const PlanDescription& request);

/// Checks `description` against `scene` and works out the above. Errors to `diagnostics`: a transmitter inside a solid,
/// a material that knows nothing of a frequency, a grid that cannot fit in memory (more than `memory_limit` bytes for
/// all results; says how many cells and what cell size would fit), an empty grid. It may be held against a description
/// with faults, to tell those of both at once: what is not finite is passed over. Warnings, one for all bands of a
/// material: a receiver inside a solid, P.2040 outside its range, a transmitter or receiver below the ground.
Plan make_plan(const PlanDescription& description, const Scene& scene, const Tracer& tracer, Diagnostics& diagnostics);

/// Three quarters of the machine's physical memory, bytes.
double memory_limit();

}  // namespace grimaldi
