#include "cli/theory_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace grimaldi {
namespace {

/// Least and largest error of the cases whose names hold all of `parts`.
struct Span {
  double least = INFINITY, most = 0;
  bool any = false;
};
Span span_of(const std::vector<CaseResult>& results, const std::vector<std::string>& parts) {
  Span span;
  for (const CaseResult& result : results) {
    const std::string name = result.subject->name + "/";
    if (!std::isfinite(result.outcome.error)) continue;
    if (!std::all_of(parts.begin(), parts.end(),
                     [&](const std::string& p) { return name.find(p) != std::string::npos; }))
      continue;
    span.least = std::min(span.least, result.outcome.error);
    span.most = std::max(span.most, result.outcome.error);
    span.any = true;
  }
  return span;
}

/// " (measured here: 0.01 to 0.3 dB)" or nothing.
std::string measured(const std::vector<CaseResult>& results, const std::vector<std::string>& parts,
                     const char* unit = " dB") {
  const Span span = span_of(results, parts);
  if (!span.any) return "";
  const std::string least = fmt::format("{:.2g}", span.least), most = fmt::format("{:.2g}", span.most);
  return fmt::format(" (measured here: {}{})", least == most ? most : least + " to " + most, unit);
}

}  // namespace

std::vector<std::string> theory_words(const std::vector<CaseResult>& results) {
  const auto range = [&](const std::vector<std::string>& parts) { return measured(results, parts); };
  return {
      "Polygon form of the free-space diffraction BSDF: the far field of a whole opening. Good where the opening is "
      "small "
      "against both legs, N = (D/2)²/λz of 0.1 and less" +
          range({"apertures/square/", "/N0.1/", "/fsd/"}) +
          ", whatever the shape: circles, stars and rings of short edges cost it nothing. Fair at N = 0.3" +
          range({"apertures/", "/N0.3/", "/fsd/"}) +
          ". Useless for openings at N of 1 and more, where it should show the "
          "opening's own shadow" +
          range({"apertures/", "/N3/", "/fsd/"}) + "; behind an obstacle the direct wave hides most of that at N = 1" +
          range({"obstacles/", "/N1/", "/fsd/"}) + ".",
      "Connected edges: each edge by its own uniform wave, with waves for its ends; on a thin screen the repaired BSDF "
      "and "
      "UTD are this one law. Behind right-angled corners it is the product of two Fresnel integrals and holds at every "
      "N, "
      "down to openings of about a wavelength" +
          range({"apertures/square/D10/", "/edges/"}) +
          ". With other corners it is good at N of 3 and more, edges longer than a wavelength and than √(λz)" +
          range({"apertures/triangle/D10/N3/", "/edges/"}) +
          "; once the whole opening lies in one Fresnel zone the corners' own waves are missing and it errs by "
          "decibels" +
          range({"apertures/triangle/", "/N0.1/", "/edges/"}) +
          ". Finely tessellated curves are many edges inside one zone: it fails there" +
          range({"apertures/ring/", "/N0.1/", "/edges/"}) + " where the polygon form is at its best" +
          range({"apertures/ring/", "/N0.1/", "/fsd/"}) + ".",
      "UTD without waves of the ends, as in textbooks, sends each edge into a strip of its own: between the strips of "
      "an "
      "opening in one Fresnel zone there is nothing at all" +
          measured(results, {"validity/holes/"}, " of the directions, triangle at N = 0.1") +
          ". Never to be used for openings.",
      "What the map says for a choice by itself: the polygon form where N is 0.1 and less; connected edges where the "
      "corners are right-angled, or N is 0.4 and more, and edges are longer than two wavelengths; in between, and for "
      "other "
      "corners, both err by 0.5 to 1.2 dB. So does `auto`: small objects as wholes up to N of 0.1" +
          range({"auto/plate/"}) + range({"auto/box/"}) + ", their edges from N of 0.4 on, both mixed between" +
          range({"auto/fade/"}) + "; long edges by UTD, short ones by the BSDF, mixed between.",
      "Solid wedges: UTD is exact for the half-plane; for other wedges what it leaves out is some hundredths of the "
      "field at "
      "kρ = 1" +
          measured(results, {"wedges/utd/270/", "/k-rho-1/"}, "") + " and falls as 1/kρ" +
          measured(results, {"wedges/utd/270/", "/k-rho-100/"}, " at kρ = 100") +
          ". Three black edges, the BSDF of a wedge, are good for a hard wedge" +
          range({"wedges/black-edges/", "/hard/"}) + " and err for a soft one near grazing" +
          range({"wedges/black-edges/270/soft/"}) + ": UTD is to be used there.",
      "The BSDF in its printed form takes the central lobe out of every edge, so that what is left depends on how "
      "finely a "
      "rim is cut; it is kept for comparison alone.",
  };
}

std::string suite_words(const std::string& suite) {
  static const std::map<std::string, std::string> words = {
      {"apertures",
       "Seven openings in a black screen under a plane wave, each at six distances. The truth is the "
       "Rayleigh-Sommerfeld "
       "integral over the opening, by a quadrature that shares nothing with the kernels. The error is the median of "
       "the "
       "difference in level over the directions in which the truth lies within 20 dB of its peak; the note tells the "
       "90 % "
       "quantile. A case with a lower bound records a failure: it misses too when the theory fails less than it must."},
      {"obstacles",
       "The same shapes as obstacles: by Babinet's principle the free wave less the wave through the opening."},
      {"validity",
       "The same error over Fresnel number and length of edge. It decides which model a run takes by itself."},
      {"wedges", "Perfectly reflecting wedges against the exact field of eigenfunctions and contour integrals."},
      {"knife-edges", "One edge, two edges, and the half-plane as a mesh through the whole engine."},
      {"screens",
       "A strip, a slit and a rectangular plate as meshes through the whole engine. The fields of all paths are added "
       "and compared with Kirchhoff's integral where the screen is black, with boundary elements where it conducts."},
      {"auto",
       "The model that chooses for itself: small plates and boxes as meshes through the whole engine against "
       "Kirchhoff's integral, and ways along which the choice changes."},
      {"roofs",
       "One and two flat roofs as meshes through the whole engine, against boundary elements: receivers from the light "
       "down into the shadow. Where nothing arrives the level counts as -100 dB."},
      {"walks",
       "Ways over shadow boundaries, over the boundaries of a reflection, past the end of an edge and around corners. "
       "The largest steps of the level are looked at with steps a hundredth as long: a slope is gone then, a jump is "
       "still there."},
      {"reciprocity", "Transmitter and receiver exchanged, one polarisation at both ends."},
      {"exhaustive",
       "The engine's search at random points of cities against one through all faces and all pairs of edges: what of "
       "the "
       "power by paths of at most two interactions it finds, class by class."},
      {"energy",
       "What diffraction takes from the light it must give to the shadow; what faces do not send back they let "
       "through."},
      {"published",
       "The figures of the paper on the free-space diffraction BSDF, in its printed and in the repaired form."},
      {"materials", "Faces, slabs and air against closed forms and printed values."},
      {"invariance",
       "What may not change the answer of the engine. Runs of few rays; where the noise of finding paths would "
       "drown the question, paths of one interaction alone."},
      {"extremes",
       "Ends of the domain: the error against many digits or quadrature, or a clear refusal; no NaN, no "
       "infinity, no silent loss."},
  };
  const auto found = words.find(suite);
  return found == words.end() ? "" : found->second;
}

}  // namespace grimaldi
