#pragma once
// Reference: the field of a line source or a plane wave about polygons in two dimensions, by boundary elements.
// exp(+jωt).

#include <complex>
#include <memory>
#include <vector>

#include "validation/wedge_field.h"

namespace grimaldi {

/// One body of the plane. Any one unit of length (that of 1/k).
struct PolygonBody {
  struct Point {
    double x, y;
  };
  std::vector<Point> corners;  ///< counter-clockwise: going along the outline, the body lies on the left
  /// Endless: the outline is open. A side comes from infinity to the first corner, another goes to infinity from the
  /// last one; `first` and `last` are the unit vectors from these corners along these sides.
  bool endless = false;
  Point first{}, last{};
};

/// How the outlines are cut.
struct BoundaryMesh {
  double panel = 0.7;  ///< longest panel, wavelengths; 8 nodes each
  int levels = 10;    ///< panels towards each corner, each a quarter of the one before; 0 where corners are nearly flat
  double reach = 20;  ///< wavelengths: endless sides are real so far, then they leave the real axis
};

/// A set of bodies at one frequency, ready for any number of sources.
///
/// Formula: soft ½q + ∫ ∂G/∂n q ds' = ∂u_i/∂n, u = u_i − ∫ G q ds', q = ∂u/∂n; hard ½u − ∫ ∂G/∂n' u ds' = u_i,
/// u = u_i + ∫ ∂G/∂n' u ds'; G = −(j/4) H_0^(2)(kR), n out of the body. Both kernels vanish along a straight side, so
/// nothing is singular. Nodes of Gauss-Legendre on panels that become shorter towards corners; near panels are halved
/// until they are far. That the field vanishes at points inside the bodies is asked besides, in least squares:
/// resonances of the inside do no harm (CHIEF). Endless sides: behind `reach` the coordinate s along the side becomes
/// s − j(s − reach); outgoing waves are analytic and fall off there, so that nothing comes back from the end.
/// Source: Colton & Kress, Integral Equation Methods in Scattering Theory (1983), 3.1; Schenck, JASA 44 (1968) 41;
/// Bremer, J. Comput. Phys. 231 (2012) 1879 for the weights; Lu, Lu & Qian, SIAM J. Appl. Math. 78 (2018) 246 for the
/// complex coordinate.
/// Inputs: k > 0 (rad per unit); bodies that do not touch; corners that are no cusps; sides of an endless body that do
/// not approach those of another. Source and receivers lie outside, at least 1e-3 wavelengths from each outline, and
/// nearer than `reach` along each endless side.
/// Valid: endless bodies under line sources alone (a plane wave does not fall off on them).
/// Error: 1e-5 of the free field with the default mesh (held by BoundaryElements.*: exact wedges; another mesh and
/// reciprocity for several bodies; the circle at resonances of its inside, the optical theorem, the thick screen).
/// Cost: N = 12 nodes to the wavelength and 160 to the corner; N² Hankel functions and two factorisations of N³: 1 s
/// at N = 1000.
/// Throws: InputErrors for k ≤ 0, a body of fewer than 3 (endless: 1) corners or clockwise, a plane wave on an endless
/// body, a source or receiver inside a body.
class BoundaryElements {
 public:
  using Point = PolygonBody::Point;
  BoundaryElements(const std::vector<PolygonBody>& bodies, double k, const BoundaryMesh& mesh = {});
  ~BoundaryElements();
  BoundaryElements(BoundaryElements&&) noexcept;
  BoundaryElements& operator=(BoundaryElements&&) noexcept;

  /// Total fields at the receivers; free field −(j/4) H_0^(2)(k|r − r_s|).
  std::vector<WedgeField> line_source(const Point& source, const std::vector<Point>& receivers) const;
  /// Total fields of a plane wave e^{−jk(x cos a + y sin a)}, which goes towards the azimuth a (rad).
  std::vector<WedgeField> plane_wave(double azimuth, const std::vector<Point>& receivers) const;

  /// Nodes on all outlines.
  std::size_t nodes() const;

 private:
  struct System;
  std::unique_ptr<System> system_;
};

/// Free field of the line source: −(j/4) H_0^(2)(k|a − b|).
std::complex<double> line_source_free_field(double k, const PolygonBody::Point& a, const PolygonBody::Point& b);

}  // namespace grimaldi
