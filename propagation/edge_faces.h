#pragma once
// The faces of one edge as its wave meets them.

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>

#include "propagation/edge_chain.h"
#include "propagation/fermat.h"
#include "propagation/plan.h"
#include "scenes/scene.h"

namespace grimaldi {

/// The two components of a wave in the cone frame of an edge, β̂ and φ̂ (sound: pressure, 0).
using ConeField = std::array<std::complex<double>, 2>;

/// A way along a face that two edges in a row bound.
struct FaceWay {
  std::uint32_t patch = no_index;
  double length = 0;  ///< m
};

/// From edge `e` to the next. Where the wave passes one of them straight on, the way goes on too: a wave of one edge
/// less has it whole.
FaceWay way_along_face(const Scene& scene, const PathGeometry& geometry, std::size_t e, double wavelength);

/// What a face does to a wave in the cone frames of an edge: rows β̂, φ̂ of the image wave, columns β̂, φ̂ of the incident
/// one.
struct Dyadic {
  std::complex<double> bb, bp, pb, pp;
};

/// By how much an image is turned from a right angle towards its own face (−: towards the other).
struct Turn {
  double angle, sine, cosine;
  Turn operator-() const { return {-angle, -sine, cosine}; }
};

/// Whose terms the images belong to.
enum class ImageRule { utd, black };

/// The faces of one edge as its wave meets them: dyadics (sound: bb alone), by the rules of laws/utd.h. Along a face
/// that the edge before (`came`) or after (`leaves`) shares, the way between the two alone.
class EdgeFaces {
 public:
  EdgeFaces(const Plan& plan, ImageRule rule, const Wedge& wedge, const EdgePassage& passage, std::size_t band,
            const Vec3& k_in, const Vec3& k_out, const FaceWay& came, const FaceWay& leaves);

  /// A wave as the term of a boundary has it: itself or its image.
  ConeField seen_at(Boundary boundary, const ConeField& wave) const;

 private:
  /// `side` 1: face 0, −1: face n.
  Dyadic dyadic(std::uint32_t patch, std::uint32_t material, const Vec3& normal, double side) const;

  const Plan& plan_;
  const ImageRule rule_;
  const Wedge& wedge_;
  const EdgePassage& passage_;
  const std::size_t band_;
  const Vec3 &k_in_, &k_out_;
  const FaceWay &came_, &leaves_;
  Turn turn_in_{}, turn_out_{};  ///< towards face 0
  Dyadic face0_{}, facen_{};
};

/// True if the term is that of the image in `face`.
bool images_in(const Wedge& wedge, const EdgeTerm& term, std::uint32_t face);

}  // namespace grimaldi
