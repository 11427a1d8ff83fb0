#pragma once
// `auto`: which theory an edge's wave is taken from, by its length and its two legs.

#include "propagation/fermat.h"
#include "propagation/plan_file.h"
#include "propagation/small_object.h"

namespace grimaldi {

/// What carries the power of diffraction, in the order of `model_power`.
enum class EdgeModel { utd, fsd, polygon, published };
inline constexpr std::size_t edge_model_count = 4;
inline constexpr const char* edge_model_names[edge_model_count] = {"utd", "fsd", "fsd-polygon", "fsd-published"};

/// Share of UTD in the wave of one passage of an edge; the rest is the repaired free-space diffraction law.
/// Formula: 1 for `utd`, 0 for `fsd`; for `auto` x = min(l/(2 r_F), l/λ), r_F = √(λ s s'/(s+s')): 1 from x = 1, 0 up to
/// x = ½, sin²(½π log₂ 2x) between: a fade over a factor of two in length, so that the level has no step where the
/// choice changes.
/// Source: this project's validity map (`grimaldi validate validity wedges screens`).
/// * 2 r_F: a longer edge has, about each diffraction point on it, the whole of its first Fresnel zone; it acts as the
///   endless wedge that UTD is exact for (0.02 dB), where the three black edges of a soft wedge near grazing err by 4
///   to 5 dB. A shorter one is an aperture of several edges; the incident wave and its images, which make every
///   boundary continuous, are then all that either law knows.
/// * λ: a face without room for one wave has no wave of its own.
/// * A free rim with faces has the same wave in both laws, whatever the share.
/// Inputs: length l of the edge, m, > 0; legs s_in and s_out of `passage`, m; wavelength λ, m.
/// Returns: 0 … 1; the same with the legs exchanged. Error: none, it is a choice. Throws: nothing.
double utd_share(DiffractionModel model, double length, const EdgePassage& passage, double wavelength);

/// Share of the whole-polygon form in the wave of an object of diameter D (that of a sphere about it).
/// Formula: with N = (D/2)²/(λL), L = s s'/(s+s'), x = min(√(N₀/N), ½ min(s, s')/D), N₀ = 0.1 of a sheet or an opening,
/// 0.5 of a solid: 1 from x = 1, 0 up to x = ½, the same fade between. So 1 up to N = N₀, 0 from N = 4 N₀. Source:
/// validity map: the polygon form is a far field, 0.1 dB up to N = 0.1 for any shape (0.4 dB at 3 λ) and 2 dB and more
/// at N = 1, where right-angled edges hold to 0.6 dB; other corners fail by 3 to 7 dB below N = 0.1. Of a solid most
/// edges are hidden from one end: alone they err by 9 to 13 dB behind a box at N = 0.5, the whole by 1 dB there and by
/// 0.45 dB from N = 0.36 down (case auto/fade-of-a-box). The second bound: directions and distances are taken from the
/// object's middle. Inputs: diameter D, m, > 0; flat or a solid; legs from the middle of the object, m; wavelength λ,
/// m. Returns: 0 … 1; the same with the legs exchanged. Error: none, it is a choice. Throws: nothing.
double polygon_share(double diameter, bool flat, double s_in, double s_out, double wavelength);

/// What another edge leaves of that share, of an object of diameter D whose edge's point lies c off the shadow boundary
/// of the other edge, as seen from the end behind that. Formula: the same fade of x = c/D: 0 up to D/2. So no edge of
/// the object crosses the boundary while the object is there as a whole, and beyond D the boundary lies clear of it.
/// Inputs: D > 0, c ≥ 0, m. Returns: 0 … 1. Error: none, it is a choice. Throws: nothing.
double clear_share(double diameter, double clearance);

/// True if the edge is of an opening that may have a share for these legs from a point of the edge: its wave goes out
/// in all directions, however far beyond the edge's ends the diffraction point then lies.
bool shines_through(const SmallObjects& objects, std::uint32_t wedge, double s_in, double s_out, double wavelength);

/// A bound on the wave of the object of a path's first edge, `s_out` behind its last, over a source of unit strength,
/// 1/m; 0 if there is none or its share is 0. Formula: 2/(s'+s) for the direct and a reflected wave that it makes up
/// for, and (k/2π) 2A/(s's) with legs from its middle, at least s_in − D/2 − b and D (where the share begins), b how
/// far beyond the edge's end the diffraction point lies, A the area of its triangles.
double object_wave_bound(const SmallObjects& objects, const EdgePassage& first, double beyond, double s_out,
                         double wavenumber);

/// The largest diameter of which polygon_share is not 0 for some legs of together at most `reach`, m.
double largest_small_diameter(double reach, double wavelength);

}  // namespace grimaldi
