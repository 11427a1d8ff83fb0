#pragma once
// The sampled estimator: power launched from edges by the free-space diffraction BSDF and counted where it crosses the
// cells. Slower than the connected map and independent of it: no sequences, no images behind the edge, no Fermat
// points.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "propagation/coverage_grid.h"
#include "propagation/plan.h"
#include "propagation/tracer.h"
#include "scenes/scene.h"

namespace grimaldi {

/// Which classes R^p E R^m are sampled: p and m at most. The plan's depth and max_reflections bound p + m too.
struct SampledClasses {
  int before = 0;
  int after = 32;
};

/// Mean path gain over the outdoor part of each cell (1; sound: m⁻²) and its standard error; NaN for cells wholly
/// inside.
struct SampledLayer {
  std::vector<double> gain, standard_error;
  std::vector<std::uint32_t> hits;  ///< samples that counted in each cell
};

/// The diffraction layer of a map for paths with one edge, by sampling the BSDF at silhouettes.
/// An edge is chosen with probability proportional to a bound of its power, a point on it with its angle at the source
/// uniform, and asked whether the source sees it; an azimuth is drawn by AzimuthLaw; the beam follows the Keller cone
/// and reflects up to the depth. Each crossing of the grid's plane in a cell of outdoor area A adds (1/N) I_Q L sin²β
/// ½Σ_pol|Σ r U|² |T|² R c/(p A |cos θ|): I_Q = antenna gain/(4π s'²), R = power reflectances and air, p the density of
/// the draw, c = λ²/4π (sound: 1), T = the ends' waves, for each term; points up to v_V = 3 beyond an end are drawn
/// too. With the model fsd_published: a ray that hits a face of the edge at a distance from its silhouette drawn from
/// the footprint (sigma = 25 λ), and a direction by PublishedScattering; it goes on from the hit behind a thin screen,
/// from the edge behind a solid. One edge at a time, silhouettes only. Source images of up to classes.before
/// reflections are tabled against all wedges: patches^p × wedges entries. Polarisation: faces and face terms by the
/// mean power of r⊥ and r∥; exact for sound and without reflection. Inputs: samples N ≥ 2, band of the plan.
/// standard_error² = (Σx² − (Σx)²/N)/(1 − 1/N), x a sample's share; gain is unbiased but for the polarisation.
/// Independent of the number of threads: draws from (seed, sample), sums in the order of the samples' blocks. `stop`,
/// if set, ends early with an empty layer.
SampledLayer sample_diffraction(const Scene& scene, const Tracer& tracer, const Plan& plan, std::size_t transmitter,
                                const CoverageGrid& grid, std::uint64_t samples, std::size_t band,
                                const SampledClasses& classes = {}, const std::atomic<bool>* stop = nullptr);

}  // namespace grimaldi
