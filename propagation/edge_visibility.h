#pragma once
// Which wedges of a scene see each other: what is once found out of a pair is kept with the scene, for every
// transmitter, band, theory and run.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/vector.h"
#include "propagation/tracer.h"
#include "scenes/scene.h"

namespace grimaldi {

/// Flat pieces of surface that hide what lies behind them as a whole: the patches whose outline is one convex loop of
/// at most 12 corners, of the others their triangles.
class ConvexFaces {
 public:
  /// The scene stays alive as long as this.
  explicit ConvexFaces(const Scene& scene);

  /// True if the surface of that triangle hides all points of one straight line from all of another, given by their
  /// ends: if it cuts the four ways between the ends, further than 2 `gap` m from them and further inside its rim than
  /// rays are off (`gap` and the patch's unevenness, over the cosine of the incidence).
  ///
  /// Why four are enough: what a convex surface cuts of a triangle is convex, so it cuts every way from a corner to the
  /// opposite side if it cuts both of the sides that leave that corner. So it hides each end of `from` from all of
  /// `to`, and then each point of `to` from all of `from`.
  bool hides(std::uint32_t triangle, const std::array<Vec3, 2>& from, const std::array<Vec3, 2>& to, double gap) const;

 private:
  struct Face {
    std::uint32_t first = 0, count = 0;  ///< of corners_, counterclockwise about the normal; 0 = not convex
    double uneven = 0;                   ///< largest distance of a corner of its triangles from the plane, m
  };
  const Scene& scene_;
  std::vector<Face> faces_;  ///< of each patch
  std::vector<Vec3> corners_;
};

/// Thread-safe: any number of threads may ask. No answer depends on what was asked before, only what it costs.
class EdgeVisibility {
 public:
  /// Scene and tracer stay alive as long as this. `most_bytes`: what may be kept; what is beyond is asked anew each
  /// time.
  explicit EdgeVisibility(const Scene& scene, const Tracer& tracer, std::size_t most_bytes = std::size_t(256) << 20);
  ~EdgeVisibility();
  EdgeVisibility(const EdgeVisibility&) = delete;
  EdgeVisibility& operator=(const EdgeVisibility&) = delete;

  /// True if nothing lies between the points at the shares `share_a`, `share_b`, 0 to 1, of two wedges' lengths, as
  /// rays see wedges (3 `Tracer::surface_gap` out along their bisectors; what is within a gap of either end does not
  /// count). One ray; none if the pair is known to be hidden. If the surface that the ray meets hides all of the one
  /// wedge from all of the other, that is kept.
  bool visible(std::uint32_t a, double share_a, std::uint32_t b, double share_b) const;

  /// True if it is known that no point of `a` sees any of `b`. Asks no ray; false says nothing.
  bool known_hidden(std::uint32_t a, std::uint32_t b) const {
    const Word* row = rows_[a].load(std::memory_order_acquire);
    return row != nullptr && (row[b / pairs_per_word].load(std::memory_order_relaxed) >> b % pairs_per_word & 1) != 0;
  }

  /// Memory of what is kept: a bit for each wedge in a row for each `a` that was asked.
  std::size_t bytes() const { return rows_kept_ * words_ * sizeof(Word); }

 private:
  using Word = std::atomic<std::uint64_t>;
  static constexpr std::uint32_t pairs_per_word = 64;

  void keep_hidden(std::uint32_t a, std::uint32_t b) const;
  Vec3 seen(const Wedge& wedge, double share) const;

  const Scene& scene_;
  const Tracer& tracer_;
  const ConvexFaces faces_;
  const std::size_t words_;  ///< of a row
  const std::size_t most_rows_;
  const std::size_t wedges_;
  const std::unique_ptr<std::atomic<Word*>[]> rows_;
  mutable std::atomic<std::size_t> rows_kept_ = 0;
};

}  // namespace grimaldi
